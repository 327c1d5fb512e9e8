#!/usr/bin/env bash
# Is this commit ready to be released? bash packaging/release.sh [--quick]
# Builds sdist, wheels for Linux, archive and wheel for Windows and the site from a clone of HEAD, all files but the site a second time from
# another clone, and compares them byte by byte; checks version, changelog, CITATION.cff and licences; prints what a person must then do.
# The files are left in DONDOLO_DIST or dist. Nothing is published. With --quick one wheel for Linux, and neither the site nor fresh
# Debians to try wheels in.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
. packaging/steps.sh

quick=${1:-}
dist=$(realpath -m "${DONDOLO_DIST:-dist}")
if [ -n "$(git status --porcelain)" ]; then
   say "release: these are not committed: $(git status --porcelain | head -n 3 | cut -c 4- | paste -sd ' ')"
   exit 1
fi
# The time in archives and programs
SOURCE_DATE_EPOCH=$(git log -1 --format=%ct)
export SOURCE_DATE_EPOCH
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
failed=0
python3 packaging/release.py texts || failed=1

# build CLONE WHEELS: all files of a release, in a clone of HEAD; what is only downloaded is shared
build() {
   local clone=$1 wheels=$2
   git clone --quiet . "$clone"
   echo /.venv >>"$clone/.git/info/exclude"
   ln -s "$PWD/.venv" "$clone/.venv"
   mkdir -p "$clone/build-windows" "$clone/dist" build-windows/libraries
   step "what Windows needs" bash packaging/windows_python.sh build-windows/python
   ln -s "$PWD/build-windows/python" "$clone/build-windows/python"
   ln -s "$PWD/build-windows/libraries" "$clone/build-windows/libraries"
   (
      cd "$clone"
      unset DONDOLO_DIST
      PATH=$PWD/.venv/bin:$PATH step "sdist" python -c 'import mesonpy; mesonpy.build_sdist("dist")'
      # shellcheck disable=SC2086
      DONDOLO_UNTRIED=${quick:-${3:-}} step "wheels for Linux" bash packaging/wheel.sh $wheels
      step "archive and wheel for Windows" bash packaging/windows.sh
   )
}
one=$PWD/.venv/bin/python
build "$work/first" "${quick:+$one}"
# In a folder whose path has another length
build "$work/second_build" "$one" untried
mkdir -p "$dist"
rm -f "$dist"/dondolo-*
cp "$work/first/dist"/* "$dist/"
python3 packaging/release.py files "$dist" "$work/second_build/dist" || failed=1
if [ -z "$quick" ]; then ./run docs || failed=1; fi
(cd "$dist" && sha256sum -- dondolo-* >SHA256SUMS.txt)
say "the files are in $dist"
exit $failed
