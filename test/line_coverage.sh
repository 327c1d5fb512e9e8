#!/usr/bin/env bash
# The lines that the tests run, of Fortran and of Python, and one number: bash test/line_coverage.sh FPM PYTHON [NAME...]
# With names, only the tests of these subjects. Fortran's lines are those that its own tests run, in a build with gcov;
# what only the tests of Python reach in the library is not counted. Nothing is optimised, which would merge lines.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
fpm=$1 python=$2
shift 2

programs=() modules=()
for name; do
   if [ -e "test/test_$name.f90" ]; then programs+=("test_$name"); fi
   for module in python/tests/test_"$name"*.py; do
      if [ -e "$module" ]; then modules+=("${module##*/}"); fi
   done
done
if [ $# -gt 0 ] && [ $((${#programs[@]} + ${#modules[@]})) -eq 0 ]; then
   printf '%s: there are no tests of %s\n' "$0" "$*" >&2
   exit 2
fi

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
failed=0
# Counts of earlier runs would be added to.
find build -name '*.gcda' -delete 2>/dev/null || true
if [ $# -eq 0 ] || [ ${#programs[@]} -gt 0 ]; then
   "$fpm" test --profile debug --flag --coverage --link-flag --coverage "${programs[@]}" >"$work/fortran.log" 2>&1 || failed=1
   tail -n 3 "$work/fortran.log"
fi
if [ $# -eq 0 ] || [ ${#modules[@]} -gt 0 ]; then
   package=$("$python" -c 'import dondolo; print(dondolo.__path__[0])')
   (cd python/tests && COVERAGE_FILE=$work/python "$python" -m coverage run --source "$package" -m pytest --color=no \
      "${modules[@]}") || failed=1
   COVERAGE_FILE=$work/python "$python" -m coverage json --quiet -o "$work/python.json"
fi
"$python" test/line_coverage.py "$work"
[ $failed = 0 ] || echo 'coverage: some tests have failed'
exit $failed
