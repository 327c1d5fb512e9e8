# Wine for tests of Windows: . test/wine.sh, where work is an empty folder
wine=/usr/lib/wine/wine64
# Without its preloader one call of Wine in some 8000 ends at once with exit code 1 and without a word: where Linux puts the heap of its
# loader at 0x7ffe0000, which Wine needs.
[ -x ${wine}-preloader ] || { echo "windows: needs wine64-preloader" >&2; exit 1; }
export WINEPREFIX=$work/wine WINEDEBUG=-all
# Ended by Wine itself, which knows its own
trap '/usr/lib/wine/wineserver64 -k; rm -rf "$work"' EXIT
$wine wineboot --init >"$work/boot.log" 2>&1
# One server for all calls: where it stops and starts between them, calls fail now and then. It ends at once if that of wineboot runs.
/usr/lib/wine/wineserver64 -w
/usr/lib/wine/wineserver64 -p || exit 1
x86_64-w64-mingw32-gcc-posix -O2 -x c -o "$work/tools.exe" test/windows_tools.inc || exit 1

contains() { grep -qF -- "$2" "$1"; }
equal() { [ "$1" = "$2" ] || { echo "'$1' should be '$2'"; return 1; }; }
# wait_for COMMAND...: up to 60 s
wait_for() {
   local i
   for ((i = 0; i < 1200; i++)); do
      "$@" && return 0
      sleep 0.05
   done
   return 1
}
# same_results FOLDER FOLDER [OPTION...]: what test/same_results.py finds is printed even where check keeps silent
exec 3>&1
same_results() { python3 "$root/test/same_results.py" "$@" >&3; }
