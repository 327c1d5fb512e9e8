#!/usr/bin/env bash
# The quick start from a wheel in a Debian without compiler or LAPACK: bash packaging/bare_debian.sh SUITE WHEEL
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
. test/debian.sh

skip_without_debian
suite=$1 wheel=$2
make_debian "$suite" "$suite-python" ca-certificates,python3,python3-venv
copy_debian "$suite-python"
cp "$wheel" packaging/quick_start.sh "$root/root/"
printf '== quick start from %s in a Debian %s without compiler\n' "${wheel##*/}" "$suite" >&2
in_debian "cd /root && bash quick_start.sh ${wheel##*/}"
