#!/usr/bin/env bash
# The package's tests with the oldest versions that pyproject.toml allows: bash test/oldest.sh
# Needs a Python for which those versions have wheels, as 3.11 has.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
place=$(mktemp -d)
trap 'rm -rf "$place"' EXIT
python3 -m venv "$place/venv"
PATH=$place/venv/bin:$PATH
mapfile -t oldest < <(python3 - <<'PYTHON'
import tomllib

with open("pyproject.toml", "rb") as file:
    content = tomllib.load(file)
project = content["project"]
wanted = [*content["build-system"]["requires"], *project["dependencies"]]
for extra in project["optional-dependencies"].values():
    wanted += extra
print(*sorted({line.replace(">=", "==") for line in wanted}), sep="\n")
PYTHON
)
printf '%s\n' "${oldest[@]}"
python3 -m pip --disable-pip-version-check install --quiet "${oldest[@]}"
python3 -m pip --disable-pip-version-check install --quiet --no-build-isolation --no-deps .
cd python/tests
# Types are those of the current NumPy and Matplotlib, whose annotations change from version to version.
python3 -m pytest --color=no --deselect test_project.py::test_types
