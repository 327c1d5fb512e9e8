# The libraries of an older Debian for the wheel to be linked with: . packaging/old_libraries.sh
# The compiler is that of this machine, so that the numbers and their speed are those of any build here; only what it links
# with is older: the C library and its headers, and GNU's libraries, which do not need a newer one.
. test/debian.sh

# old_libraries FOLDER: sets CC and FC to compilers that link with libraries that it copies to the folder
old_libraries() {
   local folder=$1 suite=bullseye machine base library name
   machine=$(gcc -print-multiarch)
   base=$debian_cache/$suite-libraries
   make_debian "$suite" "$suite-libraries" libc6-dev,libgfortran-10-dev
   mkdir -p "$folder"
   cp -L "$base/usr/lib/$machine"/{Scrt1,crt1,crti,crtn}.o "$base/usr/lib/$machine/libc_nonshared.a" \
      "$base/usr/lib/gcc/$machine"/10/lib{gfortran,gomp,quadmath,gcc_eh}.a \
      "$base/usr/lib/gcc/$machine/10/libgcc_s.so" "$base/lib/$machine/libgcc_s.so.1" "$folder"
   for library in libc.so.6 libm.so.6 libmvec.so.1 libdl.so.2 libpthread.so.0 libgfortran.so.5 libgomp.so.1 libquadmath.so.0; do
      for name in "$base/lib/$machine/$library" "$base/usr/lib/$machine/$library"; do
         if [ -e "$name" ]; then cp -L "$name" "$folder"; fi
      done
      ln -s "$library" "$folder/${library%.so.*}.so"
   done
   # Those of Debian are scripts with paths of their own; threads and dlopen are in the C library only since 2.34.
   rm "$folder"/lib{c,m}.so
   cp -L "$base/lib/$machine/ld-linux-x86-64.so.2" "$folder"
   printf 'GROUP ( libc.so.6 libc_nonshared.a AS_NEEDED ( libpthread.so.0 libdl.so.2 ld-linux-x86-64.so.2 ) )\n' >"$folder/libc.so"
   printf 'GROUP ( libm.so.6 AS_NEEDED ( libmvec.so.1 ) )\n' >"$folder/libm.so"
   # Which vector functions gfortran may call is read from finclude: the header is that of the old libmvec, which lacks erfc
   # and others. Where -B names such a folder, gfortran looks for its own modules there too.
   mkdir "$folder/finclude"
   cp "$(gfortran -print-file-name=finclude)"/* "$base/usr/include/finclude/$machine/math-vector-fortran.h" "$folder/finclude"
   export CC="gcc -B$folder -isystem $base/usr/include/$machine -isystem $base/usr/include" FC="gfortran -B$folder"
}
