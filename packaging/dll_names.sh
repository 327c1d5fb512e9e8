# Names in libraries of Windows, for other scripts: . packaging/dll_names.sh

# dll_names DLL: the names that it exports, one a line
dll_names() {
   x86_64-w64-mingw32-objdump -p "$1" |
      sed -nE '/Ordinal\/Name Pointer/,$s/^\t*\[ *[0-9]+\] *(\+base\[ *[0-9]+\] *[0-9a-f]+ +)?([A-Za-z_?@$][A-Za-z0-9_?@$]*)$/\2/p'
}
