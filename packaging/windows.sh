#!/usr/bin/env bash
# The archive for Windows, dist/dondolo-VERSION-windows.zip, and the wheel of the Python package for Windows, made on Debian by
# mingw-w64: bash packaging/windows.sh
# Needs gfortran-mingw-w64-x86-64-posix, and .venv of ./run setup for its meson and ninja. test/windows.sh and test/windows_wheel.sh
# try them. The same commit gives the same bytes.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

dist=${DONDOLO_DIST:-dist}
export PATH=$PWD/.venv/bin:$PATH
export SOURCE_DATE_EPOCH=${SOURCE_DATE_EPOCH:-$(git log -1 --format=%ct)}
version=$(sed -n 's/^version = "\(.*\)"/\1/p' pyproject.toml)
name=dondolo-$version
libraries=$PWD/build-windows/libraries
python=$PWD/build-windows/python
root=$PWD/build-windows/$name
# What the wheel holds, in a folder of its own
staged=$PWD/build-windows/staged

bash packaging/mingw_lapack.sh "$libraries"
bash packaging/windows_python.sh "$python"
printf "[built-in options]\nfortran_link_args = ['-static', '-Wl,--no-insert-timestamp', '-L%s']\n" "$libraries" >"$libraries/lapack.cross"
[ -e build-windows/meson/build.ninja ] || meson setup build-windows/meson --cross-file packaging/mingw.cross \
   --cross-file "$libraries/lapack.cross" --cross-file "$python/python.cross" -Dpython.build_config="$python/build-details.json" \
   -Dpython.platlibdir=lib/site-packages -Dpython.bytecompile=-1 -Ddatadir=. --prefix "$root"
ninja -C build-windows/meson
rm -rf "$root" "$staged"
meson install -C build-windows/meson --quiet --strip --no-rebuild --tags runtime,devel
# The extension module has the tag of programs.
rm -r "$root/lib/pkgconfig" "$root/lib/site-packages"
meson install -C build-windows/meson --quiet --strip --no-rebuild --tags runtime,python-runtime --destdir "$staged"

for program in "$root"/bin/* "$staged$root"/lib/site-packages/dondolo/_fortran/*.pyd; do
   # Windows aligns stacks to 16 bytes, which a gcc without the patch of Debian and of MSYS2 does not know (its bug 54412):
   # the program would crash where a wide vector is put on the stack. Wine does not show that.
   if x86_64-w64-mingw32-objdump -d --no-show-raw-insn "$program" | grep -E 'vmov(ap[sd]|dqa(32|64)?) .*\(%r[sb]p' | grep -q '[yz]mm'; then
      echo "windows: $program moves wide vectors to the stack as if it were aligned" >&2
      exit 1
   fi
   # Nothing but what every Windows has, and Python
   x86_64-w64-mingw32-objdump -p "$program" | awk '/DLL Name/ && !/KERNEL32|msvcrt|python3[0-9]+\.dll/ {
      print "windows: needs " $3 >"/dev/stderr"; bad = 1 } END { exit bad }'
done

mkdir "$root/licences"
cp LICENSE "$root/licences/dondolo.txt"
cp packaging/licenses/* "$root/licences/"
cp "$libraries/LICENSE" "$root/licences/LAPACK.txt"
# The start of programs, winpthreads and what msvcrt lacks
cp /usr/share/doc/mingw-w64-x86-64-dev/copyright "$root/licences/mingw-w64.txt"
[ -x build-windows/pages/bin/python ] || python3 -m venv build-windows/pages
build-windows/pages/bin/pip install --quiet --disable-pip-version-check 'markdown-it-py>=3'
mkdir -p "$dist"
rm -f "$dist"/dondolo-*-windows.zip "$dist"/dondolo-*-win_amd64.whl
wheel=$(.venv/bin/python packaging/windows_wheel.py "$staged$root" "$python/build-details.json" "$dist" "$root/licences/mingw-w64.txt")
python3 packaging/check_wheel.py "$wheel"
build-windows/pages/bin/python packaging/windows_pages.py "$root" "${wheel##*/}"
python3 - "$root" "$dist/$name-windows.zip" <<'PYTHON'
import sys
from pathlib import Path

sys.path.insert(0, "packaging")
from archives import write_archive

root = Path(sys.argv[1])
members = {path.relative_to(root.parent).as_posix(): path.read_bytes() for path in root.rglob("*") if path.is_file()}
write_archive(Path(sys.argv[2]), members)
PYTHON
ls -l "$dist/$name-windows.zip" "$wheel" >&2
