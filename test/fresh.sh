#!/usr/bin/env bash
# The README's two commands on a fresh machine: bash test/fresh.sh [VERB...]
# Each `./run VERB` (demo and then test if none is given) runs in a Debian 12 with nothing installed but git and
# certificates, on a clone of the last commit.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
. test/debian.sh

if [ $# -eq 0 ]; then
   set -- demo test
fi

need_debian || exit 1
make_debian bookworm bookworm git,ca-certificates
copy_debian bookworm
git clone --quiet . "$root/home/dondolo"
if [ -n "$(git status --porcelain)" ]; then
   printf 'a clone of %s: changes that are not committed are not in it\n' "$(git rev-parse --short HEAD)" >&2
fi

for verb; do
   printf '== ./run %s in a fresh Debian 12\n' "$verb" >&2
   in_debian "cd /home/dondolo && exec ./run $verb"
   if [ "$verb" = demo ]; then
      figures=$(find "$root/home/dondolo/out" -name '*.png' | wc -l)
      printf '== %s figures\n' "$figures" >&2
      [ "$figures" -gt 0 ]
   fi
done
printf '== passed: %s\n' "$*" >&2
