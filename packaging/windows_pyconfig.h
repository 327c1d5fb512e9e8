/* pyconfig.h of CPython for Windows on x86-64, as much as extension modules that mingw-w64 compiles read of it. Python's own, which
   is written for Microsoft's compiler, is not in the embeddable distribution. */
#ifndef DONDOLO_WINDOWS_PYCONFIG_H
#define DONDOLO_WINDOWS_PYCONFIG_H

#define MS_WINDOWS
#define MS_WIN32
#define MS_WIN64
#define NT_THREADS
#define PLATFORM "win32"

/* Names are imported from python3XX.dll. */
#define HAVE_DECLSPEC_DLL
#define Py_ENABLE_SHARED
#define MS_COREDLL

#define SIZEOF_SHORT 2
#define SIZEOF_INT 4
#define SIZEOF_LONG 4
#define SIZEOF_LONG_LONG 8
#define SIZEOF_VOID_P 8
#define SIZEOF_SIZE_T 8
#define SIZEOF_TIME_T 8
#define SIZEOF_WCHAR_T 2
#define SIZEOF_FLOAT 4
#define SIZEOF_DOUBLE 8
#define SIZEOF_PID_T 4
#define SIZEOF_OFF_T 4
#define SIZEOF_FPOS_T 8

typedef long long Py_ssize_t;
#define HAVE_PY_SSIZE_T 1
#define PY_SSIZE_T_MAX 9223372036854775807LL

#endif
