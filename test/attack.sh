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
# As in the other tests, whose objects fpm then has
profile=(--profile debug --flag -Og)
cases=12
if [ $# -gt 1 ]; then
   cases=$2
   # Without a profile, whose flags come last and would bring back warnings of array temporaries, which no reader sends
   flags='-O1 -g -fbacktrace -fcheck=all,no-array-temps -fsanitize=address,undefined -fno-sanitize-recover=undefined -fno-omit-frame-pointer'
   profile=(--flag "$flags")
   if ! [[ $cases =~ ^[1-9][0-9]{0,6}$ ]]; then
      echo "attack.sh: '$cases': the number of damaged files must be between 1 and 9999999" >&2
      exit 2
   fi
fi

# program WORD...: build a program and print its path
program() {
   local said
   said=$("$venv/bin/fpm" "$@" "${profile[@]}" --runner echo 2>"$work/log") || { cat "$work/log" >&2; return 1; }
   awk 'END { print $1 }' <<<"$said"
}

# link_readers EXECUTABLE: build test/test_readers.f90 with the library of an executable that fpm has built last, and print its
# path. fpm itself would compile every test, and leaves out of the library what the executable does not use. Sanitizers paint
# the reserve that dondolo_base_memory tries for each file, 96 MB, again and again: here it is 64 kB.
link_readers() {
   local library modules
   library=$(find build -name libdondolo.a -exec grep -q __asan_init {} \; -printf '%T@ %p\n' | sort -n | awk 'END { print $2 }')
   modules=$(find build -name 'src_core*_text_text.f90.o' -exec grep -q __asan_init {} \; -printf '%T@ %h/..\n' |
      sort -n | awk 'END { print $2 }')
   sed 's/small_things = 2_int64\*\*26, stack = 2_int64\*\*24/small_things = 2_int64**16, stack = 0_int64/' \
      src/core/base/system/memory.f90 >"$work/memory.f90"
   # shellcheck disable=SC2086
   gfortran $flags -fopenmp -J "$work" -I "$modules" -o "$work/readers" "$work/memory.f90" \
      src/study/files/number_table.f90 test/{checks,small_files,archive_files,test_readers}.f90 "$library" -llapack -lblas
   echo "$work/readers"
}

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
if [ $# -eq 1 ]; then
   # Workers have tests of their own in python/tests/test_executors.py.
   set -- "$1" "$cases" --only files bombs strangers faults kills
   checked=$exe
   readers=$(program test test_readers)
else
   checked=$(program run dondolo)
   readers=$(link_readers)
fi
"$venv/bin/python" test/attack/attack.py --programs "$exe" "$checked" "$readers" --cases "$cases" "${@:3}"
