#!/usr/bin/env bash
# The motion under long stress: bash test/stress.sh PATH/TO/fpm [HISTORIES]
# Random histories (test/test_stress.f90), constructed coincidences (test/test_coincidences.f90), and histories of walls with
# ties (test/test_tied_histories.f90), in an optimised build,
# with every check and trap, with sanitizers, and in valgrind; many lanes side by side (test/test_lanes.f90) with checks, traps
# and sanitizers; threads and grouping (test/test_grouping.f90). One line a stage; fails if any fails.
set -uo pipefail

fpm=${1:?usage: stress.sh PATH/TO/fpm [HISTORIES]}
histories=${2:-100000}
if ! [[ $histories =~ ^[1-9][0-9]{0,7}$ ]]; then
   echo "stress.sh: '$histories': the number of histories must be between 1 and 99999999" >&2
   exit 2
fi
cd "$(dirname "${BASH_SOURCE[0]}")/.." || exit 1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
jobs=$(nproc)
status=0
# Number of the first history
start=1

# executable TEST PROFILE FLAGS: build a test and print the path of its program
executable() {
   local said
   said=$("$fpm" test "$1" --profile "$2" --flag "$3" --runner echo 2>"$work/build") || {
      cat "$work/build" >&2
      return 1
   }
   tail -n 1 <<<"$said" | awk '{ print $1 }'
}

# part NUMBER COMMAND...: run a part of a stage and keep what it says
part() {
   local number=$1
   shift
   "$@" >"$work/part.$number" 2>&1 || echo "part $number ended with code $?" >"$work/broken.$number"
}

# stage NAME COUNT SIZE PROFILE FLAGS TEST [RUNNER...]: run COUNT cases in parts of SIZE, as many at once as processors
stage() {
   local name=$1 count=$2 size=$3 profile=$4 flags=$5 test=$6 program first now done=0 began=$SECONDS
   shift 6
   rm -f "$work"/part.* "$work"/broken.*
   if ! program=$(executable "$test" "$profile" "$flags"); then
      echo "$name: FAILED to build"
      status=1
      return
   fi
   for ((first = start; first < start + count; first += size)); do
      now=$((start + count - first < size ? start + count - first : size))
      while (($(jobs -rp | wc -l) >= jobs)); do wait -n; done
      [ -t 2 ] && printf '\r%s: %d of %d ' "$name" "$done" "$count" >&2
      part "$first" "$@" "$program" "$now" "$first" &
      done=$((done + now))
   done
   wait
   [ -t 2 ] && printf '\r\033[K' >&2
   cat "$work"/part.* | awk -v name="$name" -v count="$count" -v seconds=$((SECONDS - began)) '
      /^[0-9]+ passed, [0-9]+ failed/ { p += $1; f += $3 }
      END { printf "%s: %d cases, %d checks, %d failed, %d s\n", name, count, p + f, f, seconds }'
   if compgen -G "$work/broken.*" >/dev/null; then
      status=1
      cat "$work"/broken.*
      grep -h -A 12 -E 'FAILED|ERROR: |runtime error|received signal' "$work"/part.* | head -n 40
   fi
}

# at_least NUMBER LEAST
at_least() { echo $(($1 > $2 ? $1 : $2)); }

stage 'optimised' "$histories" 1000 release '' test_stress
stage 'coincidences' "$histories" 1000 release '' test_coincidences
stage 'walls with ties' "$histories" 1000 release '' test_tied_histories
traps='-fcheck=all -ffpe-trap=invalid,zero,overflow -finit-real=snan -finit-integer=-99999'
sanitizers='-fsanitize=address,undefined -fno-sanitize-recover=undefined -fno-omit-frame-pointer'
# instrumented NAME FLAGS SHARE SIZE: all tests in an instrumented build, with a share of the histories
instrumented() {
   stage "$1" "$(at_least $((histories / $3)) 10)" "$4" debug "$2" test_stress
   stage "$1, walls with ties" "$(at_least $((histories / $3)) 10)" "$4" debug "$2" test_tied_histories
   stage "$1, coincidences" "$(at_least $((histories / $3 / 4)) 10)" $(($4 / 2)) debug "$2" test_coincidences
   stage "$1, many lanes" 1 1 debug "$2" test_lanes
}
if ((histories < 1000)); then
   # A build takes longer than so few histories, which have everything in one.
   instrumented 'checks, traps and sanitizers' "$traps $sanitizers" 5 1000
else
   instrumented 'checks and traps' "$traps" 5 1000
   instrumented 'sanitizers' "$sanitizers" 25 500
fi
stage 'threads and grouping' "$(at_least $((histories / 100)) 10)" 250 release '' test_grouping
# Eight threads make a million texts, most of them messages of errors.
began=$SECONDS
if program=$(executable test_sentences release '') && DONDOLO_SENTENCES=1000000 "$program" >"$work/sentences" 2>&1; then
   echo "texts of threads: passed, $((SECONDS - began)) s"
else
   echo 'texts of threads: FAILED'
   tail -n 5 "$work/sentences"
   status=1
fi
if command -v valgrind >/dev/null; then
   # The first part brings the kept histories, some of which are long.
   start=2
   stage 'valgrind' "$(at_least $((histories / 2000)) 5)" 25 debug '' test_stress \
      valgrind --quiet --error-exitcode=1
else
   echo 'valgrind: not installed, skipped'
fi
[ $status = 0 ] || echo "stress.sh: some stages have FAILED"
exit $status
