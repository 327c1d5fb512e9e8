#!/usr/bin/env bash
# The wheel for Windows as an office meets it, by Wine: bash test/windows_wheel.sh WHEEL PYTHON PATH/TO/dondolo
# PYTHON is the folder of packaging/windows_python.sh. pip of a Python for Windows installs the wheel from a folder without a network;
# then the quick start, every ready case against the executable of this system, PATH/TO/dondolo, documents, names with accents and
# blanks, the page in the browser, a pool of processes and Ctrl-C; last the fast tests of Python that call no other program.
set -uo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.." || exit 1

wheel=$(realpath "$1") given=$(realpath "$2") ours=$(realpath "$3") root=$PWD
work=$(mktemp -d)
. test/shell_checks.sh
. test/wine.sh
# Python asks for at least Windows 8.1, and Wine is Windows 7 where nobody says otherwise.
$wine reg add 'HKCU\Software\Wine' /v Version /d win10 /f >"$work/reg.log" 2>&1

place="$work/Città è"
prefix="$place/Python"
mkdir "$place"
cp -r "$given/embed" "$prefix"
# What platform asks on Windows, and Wine has not; without it Python asks otherwise.
rm "$prefix/_wmi.pyd"
printf '%s\n' "$(basename "$prefix"/python3??.zip)" . 'Lib\site-packages' 'import site' >"$(echo "$prefix"/python3??._pth)"
python3 -m zipfile -e "$given"/wheels/pip-*.whl "$prefix/Lib/site-packages"

# in_wine PROGRAM WORDS...: sets rc, and the file said to what it prints. Python for Windows takes no file of Wine for its standard streams.
# What hangs is ended in the end, however slow the machine may be.
in_wine() {
   echo | timeout 1500 $wine "$@" 2>&1 | tr -d '\r' >"$work/said"
   rc=${PIPESTATUS[1]}
}
python() { in_wine "$prefix/python.exe" "$@"; }
# runs WHAT WORDS...: a call of Python that must end with 0
runs() {
   local what=$1
   shift
   python "$@"
   check "$what, not $rc: $(tail -n 1 "$work/said")" equal "$rc" 0
}

# --- the executable alone says what to install ---------------------------------------------------------------------

mkdir "$work/alone"
python3 -m zipfile -e "$wheel" "$work/unpacked"
cp "$work"/unpacked/dondolo-*.data/scripts/dondolo.exe "$work/alone/"
in_wine "$work/alone/dondolo.exe" relazione out/parapet
check "without Python: says what to install, not: $(cat "$work/said")" grep -q \
   'relazione needs the Python package dondolo, and there is no python.exe .*py -m pip install dondolo-.*-win_amd64.whl' "$work/said"
ln -s "$prefix" "$work/python"
WINEPATH="Z:$(tr / '\\' <<<"$work/python")" in_wine "$work/alone/dondolo.exe" relazione out/parapet
check "without the package: names the wheel for this Python, not: $(cat "$work/said")" contains "$work/said" \
   "python.exe\" -m pip install ${wheel##*/}"

# --- pip, without a network ----------------------------------------------------------------------------------------

mkdir "$place/wheels"
cp "$given"/wheels/*.whl "$wheel" "$place/wheels"
cd "$place/wheels" || exit 1
runs "pip install" -m pip install --quiet --disable-pip-version-check --no-compile --no-index --find-links . \
   "${wheel##*/}[documents,serve,spreadsheets]"
runs "pip check" -m pip --disable-pip-version-check check
bash "$root/test/wine_math.sh" "$prefix" || exit 1
echo "installed by pip: $SECONDS s"

# --- what a new user does ------------------------------------------------------------------------------------------

mkdir "$place/studio"
cd "$place/studio" || exit 1
export MPLBACKEND=agg
sed -n '/^## In Python/,/^##/{/^```python/,/^```/p}' "$root/README.md" | grep -v '^```' >quick_start.py
runs "the quick start" -W ignore quick_start.py
mkdir "$work/linux"
(cd "$work/linux" && "$root/.venv/bin/python" -W ignore "$place/studio/quick_start.py" >said)
# The first call of Matplotlib may say that it builds a cache.
check "the quick start: what Linux prints" equal "$(tail -n 1 "$work/said")" "$(tail -n 1 "$work/linux/said")"
check "the quick start: figures" test -s stripes.png -a -s fragility.png

mkdir "$work/ours"
for case in "$root"/data/cases/*.nml; do
   case=$(basename "$case" .nml)
   (cd "$work/ours" && "$ours" --quiet "$root/data/cases/$case.nml") 2>/dev/null
done
cat >cases.py <<'PYTHON'
import subprocess
import sys
import warnings
from pathlib import Path

import dondolo as dd

warnings.simplefilter("ignore")
executable = Path(sys.executable).parent / "Scripts/dondolo.exe"
mine = Path("mine/out")
mine.mkdir(parents=True)
for name in sys.argv[1:]:
    case = Path(f"{name}.nml")
    case.write_bytes(subprocess.run([executable, "--example", name], capture_output=True, check=True).stdout)
    subprocess.run([executable, "--quiet", case], check=True, stderr=subprocess.DEVNULL)
    results = dd.run_case(case, progress=False)
    main = results.response or results.stripes or results.typology
    tables = ["history"] if results.response else ["walls", "histories", "stripes", "fragility", "typology", "unions"]
    for table in tables:
        to = mine / f"{name}_{table}.csv"
        if not Path("out", to.name).exists():
            continue
        if table == "history":
            main.to_csv(to)
        elif table == "fragility" and results.fragility is not None:
            results.fragility.to_csv(to)
        else:
            main.to_csv(to, table)
    print(name)
PYTHON
mapfile -t cases < <(basename -s .nml "$root"/data/cases/*.nml)
runs "run_case of the ready cases" cases.py "${cases[@]}"
check "run_case: all" equal "$(wc -l <"$work/said")" "${#cases[@]}"
# Of rows that differ more than the others, both programs must say that they are ill-conditioned.
theirs="$wine '$prefix/Scripts/dondolo.exe'"
check "the executable of the wheel: the results of Linux" same_results "$work/ours/out" out \
   --again "'$ours'" "$theirs"
check "run_case: the results of Linux" same_results mine/out "$work/ours/out" --again "$theirs" "'$ours'"
echo "ready cases: $SECONDS s"

# --- documents -----------------------------------------------------------------------------------------------------

runs "report" -m dondolo report out/parapet
check "report: a page" contains out/parapet_report.html '</html>'
runs "figures" -m dondolo plot out/parapet
check "figures: a picture" test -s out/parapet_fragility.png
runs "relazione in HTML" -m dondolo relazione out/facade -o "relazione è.html"
check "relazione in HTML: a page" contains "relazione è.html" '</html>'
runs "relazione in Word" -m dondolo relazione out/facade -o "relazione è.docx"
check "relazione in Word: a document" python3 -m zipfile -t "relazione è.docx"
runs "workbook" -m dondolo xlsx out/parapet
check "workbook" python3 -m zipfile -t out/parapet_tables.xlsx
# The executable calls the Python that is one folder up from Scripts.
in_wine "$prefix/Scripts/dondolo.exe" report out/parapet -o rapporto.html
check "report by the executable, not: $(tail -n 1 "$work/said")" test -s rapporto.html
echo "documents: $SECONDS s"

# --- names ---------------------------------------------------------------------------------------------------------

mkdir "registrazioni è"
cp -r "$root/data/records/synthetic44" "registrazioni è/"
cp "$root/data/records/synthetic44.csv" "registrazioni è/catalogo ù.csv"
cat >names.py <<'PYTHON'
import dondolo as dd

records = dd.read_catalogue("registrazioni è/catalogo ù.csv")
wall = dd.OneSidedWall(height=1.5, thickness=0.25, name="L'Aquila è")
stripes = dd.multiple_stripe(wall, records, levels=[0.1 * i for i in range(1, 13)], polarity="both", progress=False)
stripes.save("città à.npz")
again = dd.load("città à.npz")
assert (again.edp == stripes.edp).all()
dd.report(stripes, "rapporto à.html")
print(ascii(again.wall.name), stripes.fit().theta)
PYTHON
runs "accents" -W ignore names.py
check "accents: the name of the wall" contains "$work/said" "\"L'Aquila \\xe8\""
check "accents: a report" contains "rapporto à.html" "L&#39;Aquila è"

# --- the page in the browser, a pool of processes, Ctrl-C ----------------------------------------------------------

cat >serve.py <<'PYTHON'
import http.cookiejar
import subprocess
import sys
import urllib.request

command = [sys.executable, "-m", "dondolo", "serve", "--no-browser"]
with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True) as server:
    try:
        address = server.stdout.readline().split()[-1]
        jar = urllib.request.HTTPCookieProcessor(http.cookiejar.CookieJar())
        opener = urllib.request.build_opener(urllib.request.ProxyHandler({}), jar)
        with opener.open(address, timeout=60) as answer:
            print(answer.status, "<title>" in answer.read().decode())
    finally:
        server.kill()
PYTHON
runs "serve" serve.py
check "serve: its page, not: $(tail -n 1 "$work/said")" contains "$work/said" "200 True"

cat >pool.py <<'PYTHON'
from concurrent.futures import ProcessPoolExecutor

import dondolo as dd

if __name__ == "__main__":
    walls = [dd.OneSidedWall(height=h, thickness=0.25) for h in (1.0, 1.5, 2.0, 3.0)]
    arguments = {"levels": [0.2, 0.5, 1.0], "im": "pga", "progress": False}
    alone = dd.typology(walls, dd.example_records(), **arguments)
    with ProcessPoolExecutor(2) as pool:
        shared = dd.typology(walls, dd.example_records(), executor=pool, **arguments)
    print((alone.collapses == shared.collapses).all(), alone.collapses.sum() > 0)
PYTHON
runs "a pool of processes" -W ignore pool.py
check "a pool of processes: the same counts, not: $(tail -n 1 "$work/said")" contains "$work/said" "True True"

cat >long.py <<'PYTHON'
import os
import signal
import threading
import warnings
from pathlib import Path

import numpy as np

import dondolo as dd

warnings.simplefilter("ignore")
record = dd.Record(np.sin(0.3 * np.arange(1_000_000)), 0.01)
dd.simulate(dd.OneSidedWall(3.0, 0.25), record, 2.0, history=False)
# Of the console, which has no other program in it
threading.Timer(2.0, os.kill, (0, signal.CTRL_C_EVENT)).start()
try:
    for _ in range(100_000):
        dd.simulate(dd.OneSidedWall(3.0, 0.25), record, 2.0, history=False)
except KeyboardInterrupt:
    Path("interrupted").write_text("in order")
PYTHON
# A terminal, for Wine to make a console of it
words=("$wine" "$prefix/python.exe" long.py)
timeout 200 script -qec "${words[*]@Q}" "$work/console" </dev/null >/dev/null
check "Ctrl-C: a call is interrupted" contains interrupted "in order"

# --- the fast tests of Python that call no other program -----------------------------------------------------------

mapfile -t tests < <(cd "$root/python/tests" && grep -LE 'subprocess|os\.fork|signal|resource|fcntl|playwright|multiprocessing' test_*.py)
cd "$root/python/tests" || exit 1
start=$SECONDS
runs "pip install pytest" -m pip install --quiet --disable-pip-version-check --no-compile --no-index \
   --find-links "Z:${place//\//\\}\\wheels" pytest hypothesis
runs "${#tests[@]} files of tests" -B -m pytest -p no:cacheprovider -m "not slow" --color=no "${tests[@]}"
tail -n 25 "$work/said" | grep -E '^(FAILED|ERROR)|passed|failed'
echo "tests of the package: $((SECONDS - start)) s"

echo "wheel for Windows: $SECONDS s"
echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ]
