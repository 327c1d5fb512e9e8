#!/usr/bin/env bash
# Install the OpenQuake engine into a virtual environment of its own: bash packaging/openquake.sh FOLDER
# The engine is free software under the AGPL: it is run as a program, beside dondolo. Of what it needs GDAL alone is left out,
# which has no wheel for Linux, and which it needs for landslides and rasters only. Exit code 3: it cannot be had here.
set -euo pipefail
folder=$1
version=3.26.2
if [ -x "$folder/bin/oq" ] && "$folder/bin/oq" --version 2>/dev/null | grep -q "$version"; then exit 0; fi
# A Python that it supports, and that is more than a name in PATH
python=
for name in python3 python3.12 python3.11 python3.13; do
   if "$name" -c 'import sys, venv; sys.exit(not (3, 11) <= sys.version_info[:2] <= (3, 13))' 2>/dev/null; then
      python=$name
      break
   fi
done
if [ -z "$python" ]; then
   echo "there is no Python 3.11, 3.12 or 3.13"
   exit 3
fi
rm -rf "$folder"
"$python" -m venv "$folder"
pip() { "$folder/bin/python" -m pip --quiet --disable-pip-version-check "$@"; }
pip install --no-deps "openquake.engine==$version" || exit 3
mapfile -t needed < <("$folder/bin/python" -c '
from importlib.metadata import requires
from pip._vendor.packaging.requirements import Requirement
for text in requires("openquake.engine"):
    one = Requirement(text)
    if one.name.lower() != "gdal" and (one.marker is None or one.marker.evaluate({"extra": ""})):
        print(f"{one.name}{one.specifier}")')
pip install "${needed[@]}" || exit 3
"$folder/bin/oq" --version >/dev/null
