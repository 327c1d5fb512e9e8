#!/usr/bin/env bash
# Install and compile the peers of the benchmark: install.sh BUILD_FOLDER ENVIRONMENT. Unavailable ones are reported and skipped.
set -uo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
build=$1 environment=$2
# All for the processor at hand, as the peers' just-in-time compilers and dondolo's variants do
flags=(-O3 -march=native -ffp-contract=fast -funroll-loops -std=c++17)

say() { printf 'benchmark: %s\n' "$*" >&2; }

# Debian's packages, each detected by a file or command that it contains
packages=()
command -v g++ >/dev/null || packages+=(g++)
echo '#include <boost/numeric/odeint.hpp>' | g++ -E -x c++ - >/dev/null 2>&1 || packages+=(libboost-dev)
echo '#include <cvode/cvode.h>' | g++ -E -x c++ - >/dev/null 2>&1 || packages+=(libsundials-dev)
command -v octave >/dev/null || packages+=(octave)
if ((${#packages[@]})) && [ "$(id -u)" = 0 ] && command -v apt-get >/dev/null; then
   say "installing ${packages[*]}"
   apt-get update -qq >&2
   DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "${packages[@]}" >/dev/null ||
      say "apt-get could not install all of ${packages[*]}"
fi

# It measures the limits of the processor, without which nothing is compared.
if ! command -v g++ >/dev/null; then
   say 'g++ is not installed'
   exit 1
fi

if [ ! -x "$environment/bin/python" ]; then
   say "making $environment"
   python3 -m venv "$environment"
fi
for package in scipy numba numbalsoda heyoka; do
   "$environment/bin/python" -c "import $package" 2>/dev/null && continue
   say "installing $package"
   "$environment/bin/python" -m pip --disable-pip-version-check install --quiet "$package" >&2 ||
      say "pip could not install $package"
done

compile() {
   local name=$1
   [ "$build/$name" -nt "$name.cpp" ] && [ "$build/$name" -nt hybrid.hpp ] && [ "$build/$name" -nt problem.hpp ] && return
   rm -f "$build/$name"
   g++ "${flags[@]}" "$name.cpp" -o "$build/$name" "${@:2}" 2>"$build/$name.log" ||
      say "$name.cpp does not compile, see $build/$name.log"
}

mkdir -p "$build"
compiler="g++ $(g++ -dumpfullversion), ${flags[*]}"
# What another compiler or other flags have made is made again.
[ "$compiler" = "$(cat "$build/compiler" 2>/dev/null)" ] || rm -f "$build"/*
echo "$compiler" >"$build/compiler"
# The limit of this processor and what it has for us, no programs that are compared
compile arithmetic
compile core
compile rkn4
compile odeint
compile sundials -lsundials_cvode -lsundials_arkode -lsundials_nvecserial -lsundials_sunnonlinsolfixedpoint
