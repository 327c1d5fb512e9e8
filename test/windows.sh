#!/usr/bin/env bash
# The archive for Windows as its users meet it, by Wine: bash test/windows.sh ZIP PATH/TO/dondolo
# Ready cases must have the results of the executable of this system, PATH/TO/dondolo; then names with accents and blanks, tables that
# other programs have open, killed and interrupted runs, and all of test/executable.sh.
set -uo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.." || exit 1

zip=$(realpath "$1") ours=$(realpath "$2") root=$PWD
work=$(mktemp -d)
. test/shell_checks.sh
. test/wine.sh

place="$work/Nuova cartella è"
mkdir "$place"
python3 -m zipfile -e "$zip" "$place"
folder=$(echo "$place"/dondolo-*)
exe=$folder/bin/dondolo.exe
# As test/executable.sh asks for
chmod +x "$exe"

# dondolo WORDS...: sets rc and the files stdout and stderr; a shell of Windows would run dondolo.exe itself.
dondolo() {
   timeout 1500 $wine "$exe" "$@" >"$work/raw.1" 2>"$work/raw.2"
   rc=$?
   tr -d '\r' <"$work/raw.1" >"$work/stdout"
   tr -d '\r' <"$work/raw.2" >"$work/stderr"
}

for name in licences/dondolo.txt licences/GPL-3.0.txt licences/LGPL-2.1.txt licences/LAPACK.txt licences/mingw-w64.txt docs/first_wall.html \
   docs/prima_parete.html docs/glossario.html docs/windows.html README.txt include/dondolo.h bin/libdondolo-0.dll; do
   check "the archive has $name" test -s "$folder/$name"
done

# --- what a new user does, and the same of every ready case ---------------------------------------------------------

mkdir "$work/ours" "$place/studio"
cd "$place/studio" || exit 1
for case in "$root"/data/cases/*.nml; do
   case=$(basename "$case" .nml)
   dondolo --example "$case"
   cp "$work/raw.1" "$case.nml"
   check "$case: printed" equal "$rc" 0
   dondolo "$case.nml"
   check "$case: runs" equal "$rc" 0
   (cd "$work/ours" && "$ours" --quiet "$root/data/cases/$case.nml") 2>"$work/stderr.ours"
   check "$case: the same warnings" diff <(grep -v "^dondolo: note: .*replace" "$work/stderr") "$work/stderr.ours"
done
# Of rows that differ more than the others, both programs must say that they are ill-conditioned.
again=(--again "'$ours'" "$wine '$exe'")
check "the same results in all ready cases" same_results "$work/ours/out" out "${again[@]}"

# A program in C with the library of the archive
x86_64-w64-mingw32-gcc-posix "$root/docs/examples/c_program.c" -I "$folder/include" "$folder/lib/libdondolo.dll.a" -o "$folder/bin/c_program.exe"
$wine "$folder/bin/c_program.exe" "$root/data/records/synthetic44.csv" 2>/dev/null | tr -d '\r' >"$work/stdout"
check "a program in C says what docs/c.md does" grep -qF "$(tail -n 1 "$work/stdout")" "$root/docs/c.md"
check "a program in C says something" test -s "$work/stdout"

# --- a double click ------------------------------------------------------------------------------------------------

# A console that Wine makes of a terminal, with nothing else in it, as after a double click
in_console() { (sleep 8; printf x) | script -qec "${*@Q}" /dev/null >"$work/console"; }
words() { sed 's/\x1b\[[?0-9]*[A-Za-z]//g' "$work/console" | tr -d ' \r\n'; }
SECONDS=0
in_console "$wine" "$exe"
check "a double click: shows the first steps" grep -qF 'dondolo--exampleparapet>parapet.nml' <<<"$(words)"
check "a double click: waits for a key" test "$SECONDS" -ge 8
check "a double click: then ends as without arguments" grep -qF 'nocasegiven' <<<"$(words)"
in_console "$wine" "$work/tools.exe" interrupt 3 "$exe"
check "no arguments in a command prompt: ends at once" grep -qF 'nocasegiven' <<<"$(words)"
check "no arguments in a command prompt: no first steps" test -z "$(words | grep -F exampleparapet)"
in_console "$wine" "$exe" --version
check "a console of its own with arguments: no first steps" test -z "$(words | grep -F exampleparapet)"

# A case that was dropped on the program, in another folder
mkdir -p "rilievo ì/altrove"
cp parapet.nml "rilievo ì/caso ù.nml"
cd "rilievo ì/altrove" || exit 1
SECONDS=0
in_console "$wine" "$exe" "Z:$(tr / '\\' <<<"$place")\\studio\\rilievo ì\\caso ù.nml"
check "a dropped case: waits for a key" test "$SECONDS" -ge 8
check "a dropped case: says so" grep -qF 'Pressanykeytoclosethiswindow' <<<"$(words)"
check "a dropped case: writes beside the case" test -s ../out/parapet_run.json -a ! -e out
sed -i 's/one_sided/nothing/' "../caso ù.nml"
in_console "$wine" "$exe" "Z:$(tr / '\\' <<<"$place")\\studio\\rilievo ì\\caso ù.nml"
check "a dropped case that is wrong: the error can be read" grep -qF 'Pressanykeytoclosethiswindow' <<<"$(words)"
cd "$place/studio" || exit 1
in_console "$wine" "$work/tools.exe" interrupt 6 "$exe" "Z:$(tr / '\\' <<<"$place")\\studio\\parapet.nml"
check "a whole path in a command prompt: ends at once" test -z "$(words | grep -F Pressanykey)"
dondolo relazione out/parapet
check "without Python: says what to install" grep -q 'py -m pip install dondolo-.*-win_amd64.whl' "$work/stderr"

# --- names ---------------------------------------------------------------------------------------------------------

mkdir -p "città"
cp -r "$root/data/records/synthetic44" "città/registrazioni è"
sed 's#^synthetic44/#registrazioni è/#' "$root/data/records/synthetic44.csv" >"città/registrazioni_è.csv"
sed "s#'[^']*synthetic44.csv'#'città\\\\registrazioni_è.csv'#; s#'out/parapet'#'risultati à/parapetto'#; s#'parapet'#'L''Aquila è'#" \
   parapet.nml >"caso ù.nml"
dondolo "caso ù.nml"
check "accents: runs" equal "$rc" 0
check "accents: the name of the wall" contains "risultati à/parapetto_fragility.csv" "L'Aquila è,one_sided"
check "accents: the same curve" equal "$(tail -n 1 "risultati à/parapetto_fragility.csv" | cut -d, -f 4,5)" \
   "$(tail -n 1 out/parapet_fragility.csv | cut -d, -f 4,5)"
# Wine's C: and Z: as a user of Windows writes them
drive="Z:$(pwd | tr / '\\')"
dondolo --check "$drive\\parapet.nml"
check "a path with drive and backslashes" equal "$rc" 0
sed "s#'out/parapet'#'Z:$place/studio/drive/parapet'#" parapet.nml >drive.nml
dondolo drive.nml
check "an output with a drive" test -s drive/parapet_run.json
sed "s#'out/parapet'#'out/pa:rapet'#" parapet.nml >colon.nml
dondolo colon.nml
check "a colon in an output is refused" equal "$rc" 2
check "a colon in an output: no hidden stream" equal "$(find out -name pa -o -name 'pa:*')" ""
dondolo --status out/parapet
check "status" equal "$rc" 0
deep=$(printf 'cartella_molto_lunga_%.0s' 1 2 3 4 5 6 7 8 9 10 11 12 13)
sed "s#'out/parapet'#'out/${deep:0:120}/${deep:0:120}/wall'#" parapet.nml >deep.nml
dondolo deep.nml
check "a path of more than 260 letters: refused" equal "$rc" 2
check "a path of more than 260 letters: before the run" contains "$work/stderr" "deep.nml: &job: output = 'out/cartella"
check "a path of more than 260 letters: how many are allowed" contains "$work/stderr" "Windows allows 259: shorten it"
for output in out/con out/Aux.x/wall nul; do
   sed "s#'out/parapet'#'$output'#" parapet.nml >device.nml
   dondolo device.nml
   check "the name of a device, $output: refused" equal "$rc" 2
   check "the name of a device, $output: why" contains "$work/stderr" "output = '$output': con, prn, aux, nul, com1 to com9"
done
sed "s#'out/parapet'#'out/console/com1_x'#" parapet.nml >device.nml
dondolo device.nml
check "a name that only begins with that of a device" equal "$rc" 0
dondolo --walls 1:10 historic_centre.nml
dondolo --walls 11:420 historic_centre.nml
dondolo --merge historic_centre.nml 'out/historic_centre_walls_*.counts'
check "parts: the names that * stands for" equal "$rc" 0
check "parts: the same results" same_results "$work/ours/out" out "${again[@]}"
rm -f out/*.counts

# --- a table that another program has open -------------------------------------------------------------------------

cp -r out before
$wine "$work/tools.exe" hold out/parapet_stripes.csv '' done >"$work/held" 2>/dev/null &
check "a table is held" wait_for grep -q held "$work/held"
dondolo parapet.nml
check "a table that is open: not run" equal "$rc" 2
check "a table that is open: why, not: $(cat "$work/stderr")" contains "$work/stderr" \
   'the result file out/parapet_stripes.csv is open in another program'
check "a table that is open: as it was" diff -r before out
touch done
wait $!
rm done
# Opened while the run is under way
$wine "$work/tools.exe" hold out/historic_centre_stripes.csv out/historic_centre.lock done >"$work/held" 2>/dev/null &
sleep 1
dondolo --quiet historic_centre.nml
check "a table opened meanwhile: exit code" equal "$rc" 1
check "a table opened meanwhile: why, not: $(cat "$work/stderr")" grep -q \
   'out/historic_centre_stripes.csv: cannot be replaced: is it open in another program?' "$work/stderr"
touch done
wait $!
rm done
check "a table opened meanwhile: the new one is kept" test -n "$(find out -name 'historic_centre_stripes.csv.*.part')"
dondolo --quiet historic_centre.nml
check "a table opened meanwhile: the next run mends it" equal "$rc" 0
left=$(find out -name '*.part' -o -name '*.lock')
check "a table opened meanwhile: nothing is left, not: $left" equal "$left" ""
check "a table opened meanwhile: the same results" same_results "$work/ours/out" out "${again[@]}"

# --- killed and interrupted ----------------------------------------------------------------------------------------

rm -rf out
$wine "$exe" --quiet --threads 1 historic_centre.nml >"$work/stdout" 2>&1 &
has_rows() { [ "$(stat -c %s out/historic_centre.checkpoint 2>/dev/null || echo 0)" -gt 2000 ]; }
check "killed: the checkpoint grows" wait_for has_rows
kill -9 $!
wait $! 2>/dev/null
check "killed: a lock file is left" test -e out/historic_centre.lock
dondolo --status out/historic_centre
check "killed: status" equal "$rc" 0
dondolo historic_centre.nml
check "killed: goes on, not: $(cat "$work/stderr")" test "$rc" = 0
check "killed: rows of the earlier run" grep -q ' by an earlier run' "$work/stdout"
check "killed: nothing is left" equal "$(find out -name '*.part' -o -name '*.lock' -o -name '*.checkpoint')" ""
rm -rf "$work/only" && mkdir "$work/only" && cp "$work"/ours/out/historic_centre_*.csv "$work/only"
check "killed: the same results" same_results "$work/only" out
rm -rf out
# A terminal, for Wine to make a console of it
words=("$wine" "$work/tools.exe" interrupt 3 "$exe" --quiet --threads 1 historic_centre.nml)
check "Ctrl-C: the code of a program that it ends" script -qec "${words[*]@Q}" /dev/null
check "Ctrl-C: the checkpoint is kept" test -s out/historic_centre.checkpoint
check "Ctrl-C: no lock is left" test ! -e out/historic_centre.lock
dondolo --quiet historic_centre.nml
check "Ctrl-C: the same results" same_results "$work/only" out

# --- two runs at once -----------------------------------------------------------------------------------------------

$wine "$exe" --quiet --threads 1 historic_centre.nml >/dev/null 2>&1 &
check "two at once: the first has its lock" wait_for test -e out/historic_centre.lock
dondolo historic_centre.nml
check "two at once: the second is refused, not: $(cat "$work/stderr")" grep -q 'is being written by another run (process' "$work/stderr"
check "two at once: exit code" equal "$rc" 2
wait $!
echo "$passed passed, $failed failed"

bash "$root/test/executable.sh" "$exe" && [ "$failed" -eq 0 ]
