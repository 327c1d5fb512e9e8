#!/usr/bin/env bash
# Complex mathematics that the C library of Wine 8 lacks, for a copy of Python that is tried by Wine: bash test/wine_math.sh PREFIX
# NumPy and SciPy stop there when they call crealf and its kin. Wine takes api-ms-win-crt-math-l1-1-0.dll for its own C library,
# whatever lies beside the program: so the modules that call crealf are made, in this copy alone, to ask for another name of the same
# length. The library of that name hands everything on to the C library but these functions, which it has from mingw-w64.
set -euo pipefail
prefix=$1
asked=api-ms-win-crt-math-l1-1-0.dll other=xpi-ms-win-crt-math-l1-1-0.dll
own='(cabs|cacos|cacosh|carg|casin|casinh|catan|catanh|ccos|ccosh|cexp|cimag|clog|conj|cpow|cproj|creal|csin|csinh|csqrt|ctan|ctanh)f?'
. "$(dirname "${BASH_SOURCE[0]}")/../packaging/dll_names.sh"

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
dll_names "$WINEPREFIX/drive_c/windows/system32/ucrtbase.dll" >"$work/names"
{
   printf 'LIBRARY %s\nEXPORTS\n' "$other"
   grep -vxE "$own" "$work/names" | sed 's/.*/   & = ucrtbase.&/'
   grep -xE "$own" "$work/names"
} >"$work/math.def"
x86_64-w64-mingw32-gcc-posix -shared -static -o "$prefix/$other" "$work/math.def"
grep -rlZ --include='*.pyd' crealf "$prefix/Lib/site-packages" | xargs -0 sed -i "s/${asked//./\\.}/$other/"
