#!/usr/bin/env bash
# LAPACK and BLAS for the executable for Windows, from Debian's source package of LAPACK: bash packaging/mingw_lapack.sh FOLDER
# Makes liblapack.a and libblas.a in the folder, of the routines that dondolo calls and those that these call. apt checks the
# signature of the source; nothing is installed.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

fortran=x86_64-w64-mingw32-gfortran-posix
folder=$(realpath -m "$1")
mkdir -p "$folder"
[ ! -e "$folder/liblapack.a" ] || exit 0
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# The sources of packages, where this system reads those of programs
mkdir -p "$work/lists/partial" "$work/cache/archives/partial"
for list in /etc/apt/sources.list /etc/apt/sources.list.d/*.list; do
   if [ -e "$list" ]; then sed -n 's/^deb \(.*\)/deb-src \1/p' "$list"; fi
done >"$work/sources.list"
mkdir "$work/sources"
for list in /etc/apt/sources.list.d/*.sources; do
   if [ -e "$list" ]; then sed 's/^Types:.*/Types: deb-src/' "$list" >"$work/sources/${list##*/}"; fi
done
options=(-o "Dir::Etc::sourcelist=$work/sources.list" -o "Dir::Etc::sourceparts=$work/sources" -o "Dir::State::Lists=$work/lists"
   -o "Dir::Cache=$work/cache" -o APT::Sandbox::User=root)
apt-get "${options[@]}" update
(cd "$work" && apt-get "${options[@]}" source --download-only lapack)
mkdir "$work/lapack"
tar -xf "$work"/lapack_*.orig.tar.* -C "$work/lapack" --strip-components=1

# Compile what is called and not there yet, until nothing is
mapfile -t wanted < <(sed -n 's/^ *pure subroutine \([a-z0-9]*\)(.*/\1/p' src/core/base/numerics/lapack.f90)
while [ ${#wanted[@]} -gt 0 ]; do
   for name in "${wanted[@]}"; do
      for room in SRC INSTALL BLAS/SRC; do
         for source in "$work/lapack/$room/$name".f "$work/lapack/$room/$name".f90; do
            if [ -e "$source" ] && [ ! -e "$work/$name.o" ]; then
               "$fortran" -O2 -c "$source" -J "$work" -o "$work/$name.o"
               # The routines of BLAS are a library of their own.
               if [ "$room" = BLAS/SRC ]; then ln -s "$name.o" "$work/$name.blas"; fi
            fi
         done
      done
   done
   mapfile -t wanted < <(x86_64-w64-mingw32-nm -u "$work"/*.o | sed -n 's/^ *U \([a-z0-9]*\)_$/\1/p' | sort -u |
      while read -r name; do
         if [ ! -e "$work/$name.o" ]; then
            for source in "$work"/lapack/{SRC,INSTALL,BLAS/SRC}/"$name".f*; do
               if [ -e "$source" ]; then echo "$name"; fi
            done
         fi
      done)
done
blas=() lapack=()
for object in "$work"/*.o; do
   if [ -e "${object%.o}.blas" ]; then blas+=("$object"); else lapack+=("$object"); fi
done
x86_64-w64-mingw32-gcc-ar-posix rcs "$folder/libblas.a" "${blas[@]}"
x86_64-w64-mingw32-gcc-ar-posix rcs "$folder/liblapack.a" "${lapack[@]}"
cp "$work/lapack/LICENSE" "$folder/"
printf 'LAPACK: %s\n' "$(cd "$work" && echo *.o)" >&2
