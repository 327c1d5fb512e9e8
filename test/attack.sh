#!/usr/bin/env bash
# Damaged files, calls that fail, kills, runs side by side: bash test/attack.sh PATH/TO/dondolo [CASES [OPTION...]]
# With CASES, the damaged files of each reader, the readers and the executable are built with sanitizers; without, a
# short part runs in the build of the other tests. The options are those of test/attack/attack.py.
set -euo pipefail

if [ $# -lt 1 ] || [ ! -x "$1" ]; then
   echo "usage: attack.sh PATH/TO/dondolo [CASES [OPTION...]]" >&2
   exit 2
fi
exe=$(realpath "$1")
cd "$(dirname "${BASH_SOURCE[0]}")/.."
venv=$PWD/.venv
flags=-Og
cases=12
if [ $# -gt 1 ]; then
   cases=$2
   flags='-O1 -fcheck=all,no-array-temps -fsanitize=address,undefined -fno-sanitize-recover=undefined -fno-omit-frame-pointer'
   if ! [[ $cases =~ ^[1-9][0-9]{0,6}$ ]]; then
      echo "attack.sh: '$cases': the number of damaged files must be between 1 and 9999999" >&2
      exit 2
   fi
fi

# program WORD...: build a program and print its path
program() {
   local said
   said=$("$venv/bin/fpm" "$@" --profile debug --flag "$flags" --runner echo 2>"$log") || { cat "$log" >&2; return 1; }
   awk 'END { print $1 }' <<<"$said"
}
log=$(mktemp)
trap 'rm -f "$log"' EXIT
# In this order: fpm leaves modules out of the library that the executable does not use, and does not notice later.
readers=$(program test test_readers)
checked=$exe
[ $# -eq 1 ] || checked=$(program run dondolo)
"$venv/bin/python" test/attack/attack.py --programs "$exe" "$checked" "$readers" --cases "$cases" "${@:3}"
