#!/usr/bin/env bash
# The quick start from a wheel in a Debian without compiler or LAPACK: bash packaging/bare_debian.sh SUITE FOLDER
# The folder may hold wheels of several Pythons, as that of a release does; the one that fits is taken.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
. test/debian.sh

if ! need_debian; then
   printf 'skipped: the quick start in a fresh Debian\n' >&2
   exit 0
fi
suite=$1 folder=$2
make_debian "$suite" "$suite-python" ca-certificates,python3,python3-venv
copy_debian "$suite-python"
mkdir "$root/root/wheels"
cp "$folder"/*.whl "$root/root/wheels/"
cp packaging/quick_start.sh "$root/root/"
printf '== quick start from the wheels of %s in a Debian %s without compiler\n' "$folder" "$suite" >&2
in_debian "cd /root && bash quick_start.sh wheels"
