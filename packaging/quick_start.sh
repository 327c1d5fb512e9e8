#!/usr/bin/env bash
# What the README promises of an installation by pip, in an empty folder: bash quick_start.sh FOLDER
# Runs inside the Debian of bare_debian.sh, with the wheels in the folder.
set -euo pipefail

! command -v gfortran cc gcc ld
python3 -m venv /root/venv
# By the name of its file: a package that a server calls dondolo would be somebody else's.
tag=$(/root/venv/bin/python -c 'import sys; print("cp%d%d" % sys.version_info[:2])')
/root/venv/bin/pip install --quiet --disable-pip-version-check "/root/$1"/dondolo-*-"$tag"-*.whl
export PATH=/root/venv/bin:$PATH
mkdir /root/empty
cd /root/empty
start=$EPOCHREALTIME

dondolo --version
dondolo --example parapet >parapet.nml
dondolo --quiet parapet.nml
dondolo plot out/parapet
test -s out/parapet_fragility.png
first_figure=$(awk "BEGIN { print $EPOCHREALTIME - $start }")
dondolo report out/parapet
test -s out/parapet_report.html
dondolo --example population >population.nml
dondolo run --quiet population.nml
dondolo nrml out/population

cat >quick_start.py <<'PYTHON'
import dondolo as dd

records = dd.example_records()
wall = dd.OneSidedWall(height=1.5, thickness=0.25, name="parapet")
stripes = dd.multiple_stripe(wall, records, levels=[0.1 * i for i in range(1, 13)], polarity="both")
stripes.plot().figure.savefig("stripes.png")
stripes.fit().plot().figure.savefig("fragility.png")
print(stripes.fit())
PYTHON
python quick_start.py
test -s stripes.png
test -s fragility.png
python - <<'PYTHON'
import subprocess
import sys
import time

start = time.perf_counter()
subprocess.run([sys.executable, "-c", "import dondolo"], check=True)
print(f"import: {time.perf_counter() - start:.2f} s")
PYTHON
echo "first figure after $first_figure s"
