#!/usr/bin/env bash
# The package's tests with the oldest versions that pyproject.toml allows: bash test/oldest.sh [--quick]
# With --quick only the fast tests, and without the packages of the documentation, which no test needs.
# Needs a Python for which those versions have wheels, as 3.11 has.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
. packaging/steps.sh
place=$(mktemp -d)
trap 'rm -rf "$place"' EXIT
python3 -m venv "$place/venv"
PATH=$place/venv/bin:$PATH
mapfile -t oldest < <(python3 - "$@" <<'PYTHON'
import sys
import tomllib

with open("pyproject.toml", "rb") as file:
    content = tomllib.load(file)
project = content["project"]
wanted = [*content["build-system"]["requires"], *project["dependencies"]]
for name, extra in project["optional-dependencies"].items():
    if name != "docs" or "--quick" not in sys.argv:
        wanted += extra
print(*sorted({line.replace(">=", "==") for line in wanted}), sep="\n")
PYTHON
)
printf '%s\n' "${oldest[@]}"
step "installing these by pip" python3 -m pip --disable-pip-version-check install "${oldest[@]}"
step "building with them" python3 -m pip --disable-pip-version-check install --verbose --no-build-isolation --no-deps .
cd python/tests
# Types are those of the current NumPy and Matplotlib, whose annotations change from version to version.
options=(--color=no --deselect python/tests/test_project.py::test_types)
if [ "${1:-}" = --quick ]; then options+=(-n 2 --dist loadfile -m 'not slow'); fi
python3 -m pytest "${options[@]}" || {
   printf 'oldest: some tests fail with the oldest versions\n' >&2
   exit 1
}
