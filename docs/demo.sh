#!/usr/bin/env bash
# Ready cases on the synthetic accelerograms, their figures and a report: bash docs/demo.sh DONDOLO PYTHON
# The first prints what a run of the executable prints, the others their medians.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
dondolo=$1 python=$2
cases=(parapet two_block facade population historic_centre history)

printf '\n$ dondolo data/cases/%s.nml\n' "${cases[0]}"
"$dondolo" "data/cases/${cases[0]}.nml" 2>&1
for case in "${cases[@]:1}"; do
   printf '\n$ dondolo --quiet data/cases/%s.nml\n' "$case"
   "$dondolo" --quiet "data/cases/$case.nml"
   "$python" docs/demo.py "out/$case"
done

printf '\ndrawing the figures, and writing the report of the historic centre and the calculation report of the facade\n'
# Side by side
"$python" -W ignore -m dondolo report out/historic_centre >/dev/null &
report=$!
trap 'kill "$report" 2>/dev/null || true' EXIT
"$python" -W ignore -m dondolo relazione out/facade --lang it -o out/facade_relazione.html >/dev/null
"$python" -W ignore -m dondolo plot "${cases[@]/#/out/}" >/dev/null
wait "$report"
trap - EXIT
cat <<TEXT
$(find out -name '*.png' -newer "out/${cases[0]}_run.json" | wc -l) figures are in $PWD/out.

Next:
  1. Open out/historic_centre_report.html in a browser: curves, tables, inputs and checks of 240 walls.
  2. Open out/facade_relazione.html: the calculation report of the facade, in Italian; docs/relazione.md tells how to get it
     in Word.
  3. Write $dondolo --example parapet into my_wall.nml, put in your wall, and run it: first with --check, then
     without. docs/tutorial/first_wall.md explains each line (in italiano: docs/tutorial/prima_parete.md).
  4. Use your own accelerograms: $dondolo catalogue FOLDER lists what it can read of them, and docs/ground_motions.md
     tells which to choose. The ones here are synthetic, and serve for examples only.
TEXT
