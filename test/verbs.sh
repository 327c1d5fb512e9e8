#!/usr/bin/env bash
# Each verb of ./run in its smallest form: bash test/verbs.sh [VERB...]
# Prints one line for each that has ended: what became of it, its minutes and those of processors, and for one that failed its
# last line. Fails if any fails, or if the sources are not as they were. Two verbs run at once, but those that build by fpm,
# which share its folder, run one after the other. What they print and write is in out/verbs and out/quick.
set -uo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.." || exit 1

# Verbs in their smallest forms
by_fpm=('stress 100' 'attack 5' 'reference --quick' 'coverage wall' 'verification --quick' 'synthetic44 out/quick/records')
others=('oldest --quick' 'openquake --quick' 'wheel python3' 'windows --quick' 'page' 'mutations --quick' 'docs' 'city --quick'
   'figures out/quick/figures' 'experiments --check' 'intervals --quick' 'benchmark --quick')
wanted=("$@")
logs=out/verbs
line='%-32s %-8s %7s %7s  %s\n'

name_of() { echo "${1%% *}"; }

is_wanted() {
   local word
   [ ${#wanted[@]} -gt 0 ] || return 0
   for word in "${wanted[@]}"; do [ "$word" = "$(name_of "$1")" ] && return 0; done
   return 1
}

# Why a verb cannot run here, if it cannot
obstacle() {
   case $1 in
      windows*)
         command -v x86_64-w64-mingw32-gcc-posix apt-get >/dev/null || echo "needs gcc-mingw-w64-x86-64-posix" ;;
      oldest*)
         command -v python3.11 python3.12 >/dev/null || echo "needs Python 3.11 or 3.12" ;;
   esac
}

# What changed of the sources: git knows
sources() { git status --porcelain 2>/dev/null; git diff HEAD 2>/dev/null | cksum; }

# try FORM: run a verb and print its line
try() {
   local form=$1 log why status=0 outcome=passed time
   is_wanted "$form" || return 0
   log=$logs/$(name_of "$form").log
   why=$(obstacle "$form")
   if [ -n "$why" ]; then
      # shellcheck disable=SC2059
      printf "$line" "$form" skipped - - "$why"
      return
   fi
   TIMEFORMAT='%R %U %S'
   # shellcheck disable=SC2086
   time=$({ time DONDOLO_DIST=out/quick/dist ./run $form >"$log" 2>&1; } 2>&1) || status=$?
   if [ "$form" = 'synthetic44 out/quick/records' ] && ! diff -rq data/records/synthetic44 out/quick/records/synthetic44 >>"$log"; then
      status=1
   fi
   if [ $status != 0 ]; then
      outcome=FAILED
      why=$(grep -v '^[[:space:]]*$' "$log" | tail -n 1)
      name_of "$form" >>"$logs/failed"
   fi
   # shellcheck disable=SC2059,SC2086
   printf "$line" "$form" "$outcome" $(awk '{ printf "%.1f %.1f", $1 / 60, ($2 + $3) / 60 }' <<<"$time") "$why"
}

for word in "${wanted[@]}"; do
   known=
   for form in "${by_fpm[@]}" "${others[@]}"; do [ "$word" = "$(name_of "$form")" ] && known=1; done
   if [ -z "$known" ]; then
      echo "verbs: there is no small form of '$word'; there are: $(for form in "${by_fpm[@]}" "${others[@]}"; do name_of "$form"; done |
         tr '\n' ' ')" >&2
      exit 2
   fi
done

mkdir -p "$logs"
rm -rf "$logs"/* out/quick
began=$SECONDS
before=$(sources)
# shellcheck disable=SC2059
printf "$line" verb outcome minutes 'of CPU' ''
# In a group of its own, so that what it runs ends with it
set -m
(for form in "${others[@]}"; do try "$form"; done) &
other=$!
set +m
trap 'kill -- -"$other" 2>/dev/null || true' EXIT
trap 'exit 130' INT
trap 'exit 143' HUP TERM
for form in "${by_fpm[@]}"; do try "$form"; done
wait "$other"
trap - EXIT
if [ "$(sources)" != "$before" ]; then
   echo "the sources have changed:"
   diff <(echo "$before") <(sources)
   echo 'the sources, which have changed' >>"$logs/failed"
fi
awk -v s=$((SECONDS - began)) 'BEGIN { printf "verbs: %.1f minutes; what each printed is in out/verbs\n", s / 60 }'
if [ -e "$logs/failed" ]; then
   echo "verbs: failed: $(paste -sd, "$logs/failed")"
   exit 1
fi
