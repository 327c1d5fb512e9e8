#!/usr/bin/env bash
# Populations that run for a while: bash test/large_population.sh PATH/TO/dondolo
# Runs that are killed at random moments must end with the same bytes as one that is not, parts that are merged too, and
# more walls must take little more memory.
set -uo pipefail

if [ $# -ne 1 ] || [ ! -x "$1" ]; then
   echo "usage: large_population.sh PATH/TO/dondolo" >&2
   exit 2
fi
exe=$(realpath "$1")
root=$(realpath "$(dirname "${BASH_SOURCE[0]}")/..")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work" || exit 1
. "$root/test/shell_checks.sh"

# So many walls in three groups, every third with two mechanisms
population() {
   awk -v n="$1" 'BEGIN {
      print "name,mechanism,height,thickness,hinge,weight,group,p_occ"
      for (i = 1; i <= n; i++) {
         h = 2.5 + 1.5 * (i * 0.618034 % 1); t = 0.2 + 0.3 * (i * 0.414214 % 1)
         print "w" i ",one_sided," h "," t ",," 1 + i % 4 ",g" i % 3 "," 0.5 + 0.1 * (i % 5)
         if (i % 3 == 0) print "w" i ",two_block," h "," t "," 0.6 "," 1 + i % 4 ",g" i % 3 ",0.5"
      }
   }'
}

# A case of such walls, with levels
study() {
   cat <<NML
&job task = 'typology', output = 'out/study' /
&population file = 'walls.csv' /
&records catalogue = '${2:-$root/data/records/synthetic44.csv}' /
&stripes $1 /
NML
}

# Low levels, at which histories are short
population 450 >walls.csv
study 'first = 0.03, last = 0.315, count = 20, edp_thresholds = 0.1' >study.nml
began=$(date +%s%N)
"$exe" --quiet study.nml 2>/dev/null
lasts=$((($(date +%s%N) - began) / 1000000))
mv out whole
check "a run that is not killed leaves no checkpoint" test ! -e whole/study.checkpoint

# Killed again and again at random moments, until a run ends
tries=0
while [ $tries -lt 6 ]; do
   "$exe" --quiet --threads $((1 + tries % 2)) study.nml 2>/dev/null &
   pid=$!
   sleep "$(awk -v seed="$RANDOM" -v lasts="$lasts" 'BEGIN { srand(seed); print lasts / 1000 * (0.1 + 0.5 * rand()) }')"
   kill -KILL $pid 2>/dev/null || true
   wait $pid 2>/dev/null && break
   tries=$((tries + 1))
   check "killed: no result file, whole or in part" test ! -e out/study_typology.csv
done
[ $tries -lt 6 ] || "$exe" --quiet study.nml 2>/dev/null
check "killed $tries times: the same bytes" same whole out
rm -rf out

# Killed when the first block is done: that block is not computed again
"$exe" --quiet --threads 1 study.nml 2>/dev/null &
pid=$!
for _ in $(seq 600); do
   [ "$(stat -c %s out/study.checkpoint 2>/dev/null || echo 0)" -lt 1000 ] || break
   sleep 0.05
done
kill -KILL $pid
wait $pid 2>/dev/null
"$exe" study.nml >stdout 2>/dev/null
check "killed after a block: the same bytes" same whole out
check "killed after a block: says what was there" grep -q 'those of [0-9]* rows* by an earlier run' stdout
rm -rf out

# Parts, by different numbers of threads and out of order
rows=$(($(wc -l <walls.csv) - 1))
"$exe" --quiet --walls 401:9999 --threads 1 study.nml 2>/dev/null
"$exe" --quiet --walls 1:400 study.nml 2>/dev/null
check "parts: their files" test -e out/study_walls_1-400.counts -a -e "out/study_walls_401-$rows.counts"
"$exe" --quiet --merge study.nml out/study_walls_*.counts 2>/dev/null
rm out/*.counts
check "parts: the same bytes" same whole out
rm -rf out

# Memory: five times the walls, four records; what grows is the text of the table, which is known, the counts and curves of each
# row and wall, and what they are made with
if command -v /usr/bin/time >/dev/null; then
   sed -n "2p; 3~11s|^|$root/data/records/|p" "$root/data/records/synthetic44.csv" >few.csv
   study 'levels = 0.01' few.csv >study.nml
   for n in 8000 40000; do
      population $n >walls.csv
      # One thread: what several hold beside it differs from run to run.
      /usr/bin/time -f %M "$exe" --quiet --threads 1 study.nml 2>&1 | tail -n 1 >>memory
      stat -c %s walls.csv >>texts
   done
   check "memory: $(tr '\n' ' ' <memory) KiB for 8000 and 40000 walls" awk '{ m[NR] = $1 } END { exit !(m[2] < m[1] + 15872 + (m[4] - m[3]) / 1024) }' memory texts
fi

echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ]
