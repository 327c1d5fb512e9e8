/* Library to preload: the k-th call on a file of a folder fails, is cut short, or kills the process.

   ATTACK_FOLDER  calls count that are on files below it (an absolute path)
   ATTACK_LARGE   allocations of so many bytes or more count instead of calls on files
   ATTACK_AT      number of the call that fails; 0: none
   ATTACK_HOW     an error number; 0: cut short; -1: killed before the call; -2: killed after it
   ATTACK_LOG     file that gets a line for each call that counts */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/types.h>
#include <unistd.h>

#define MOST 4096
#define REAL(type, name, ...) \
   static type (*real)(__VA_ARGS__); \
   if (real == NULL) \
      real = (type (*)(__VA_ARGS__))dlsym(RTLD_NEXT, name)

static char watched[MOST];
static atomic_int calls;
static long at, how, large;
static const char *folder;
static int log_descriptor = -1, is_ready;

/* Begin to count; for a process that forks others, each of which calls it with its own numbers and log, "": none */
void attack_begin(long number, long kind, const char *text)
{
   at = number;
   how = kind;
   atomic_store(&calls, 0);
   if (*text != 0) {
      REAL(int, "open", const char *, int, ...);
      log_descriptor = real(text, O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
   }
   is_ready = 1;
}

static const char *given(const char *name, const char *otherwise)
{
   return getenv(name) ? getenv(name) : otherwise;
}

__attribute__((constructor)) static void prepare(void)
{
   folder = getenv("ATTACK_FOLDER");
   large = atol(given("ATTACK_LARGE", "0"));
   attack_begin(atol(given("ATTACK_AT", "0")), atol(given("ATTACK_HOW", "0")), given("ATTACK_LOG", ""));
}

/* Is this the call? A kill before it happens here. */
static int hit(const char *name, const char *path)
{
   int number;

   if (!is_ready)
      return 0;
   number = atomic_fetch_add(&calls, 1) + 1;
   if (log_descriptor >= 0)
      dprintf(log_descriptor, "%d %s %s\n", number, name, path);
   if (number != at)
      return 0;
   if (how == -1)
      kill(getpid(), SIGKILL);
   return 1;
}

/* After a call that was hit: the kill that comes late */
static void late(int is_hit)
{
   if (is_hit && how == -2)
      kill(getpid(), SIGKILL);
}

/* Does a call that was hit fail? */
static int fails(int is_hit)
{
   if (is_hit && how > 0)
      errno = (int)how;
   return is_hit && how > 0;
}

static int below(const char *path)
{
   return large == 0 && folder != NULL && path != NULL && strncmp(path, folder, strlen(folder)) == 0;
}

static int is_watched(int descriptor)
{
   return descriptor >= 0 && descriptor < MOST && watched[descriptor];
}

static int note(int descriptor)
{
   if (descriptor >= 0 && descriptor < MOST)
      watched[descriptor] = 1;
   return descriptor;
}

static int open_as(const char *path, int flags, mode_t mode)
{
   REAL(int, "open", const char *, int, ...);
   int is_hit, made;

   if (!below(path))
      return real(path, flags, mode);
   is_hit = hit("open", path);
   if (fails(is_hit))
      return -1;
   made = note(real(path, flags, mode));
   late(is_hit);
   return made;
}

#define OPEN(name) \
   int name(const char *path, int flags, ...) \
   { \
      va_list rest; \
      mode_t mode; \
      va_start(rest, flags); \
      mode = (flags & O_CREAT) ? va_arg(rest, mode_t) : 0; \
      va_end(rest); \
      return open_as(path, flags, mode); \
   }
OPEN(open)
OPEN(open64)

#define FOPEN(name) \
   FILE *name(const char *path, const char *mode) \
   { \
      REAL(FILE *, #name, const char *, const char *); \
      int is_hit; \
      FILE *made; \
      if (!below(path)) \
         return real(path, mode); \
      is_hit = hit("fopen", path); \
      if (fails(is_hit)) \
         return NULL; \
      made = real(path, mode); \
      if (made != NULL) \
         note(fileno(made)); \
      late(is_hit); \
      return made; \
   }
FOPEN(fopen)
FOPEN(fopen64)

#define TRANSFER(name, pointer, more, ...) \
   ssize_t name(int descriptor, pointer bytes, size_t length more) \
   { \
      REAL(ssize_t, #name, int, pointer, size_t __VA_ARGS__); \
      int is_hit = is_watched(descriptor) && hit(#name, ""); \
      ssize_t done; \
      if (fails(is_hit)) \
         return -1; \
      if (is_hit && how == 0) \
         length /= 2; \
      done = CALL; \
      late(is_hit); \
      return done; \
   }
#define COMMA ,
#define CALL real(descriptor, bytes, length)
TRANSFER(write, const void *, )
TRANSFER(read, void *, )
#undef CALL
#define CALL real(descriptor, bytes, length, place)
TRANSFER(pwrite, const void *, COMMA off_t place, COMMA off_t)
TRANSFER(pwrite64, const void *, COMMA off_t place, COMMA off_t)
TRANSFER(pread, void *, COMMA off_t place, COMMA off_t)
TRANSFER(pread64, void *, COMMA off_t place, COMMA off_t)

size_t fwrite(const void *bytes, size_t size, size_t count, FILE *file)
{
   REAL(size_t, "fwrite", const void *, size_t, size_t, FILE *);
   int is_hit = is_watched(fileno(file)) && hit("fwrite", "");
   size_t done;

   if (fails(is_hit))
      return 0;
   done = real(bytes, size, is_hit && how == 0 ? count / 2 : count, file);
   late(is_hit);
   return done;
}

#define ON_FILE(name) \
   int name(FILE *file) \
   { \
      REAL(int, #name, FILE *); \
      int is_hit = file != NULL && is_watched(fileno(file)) && hit(#name, ""); \
      int done; \
      if (is_hit && how > 0 && strcmp(#name, "fclose") != 0) { \
         errno = (int)how; \
         return EOF; \
      } \
      if (file != NULL && fileno(file) >= 0 && fileno(file) < MOST && strcmp(#name, "fclose") == 0) \
         watched[fileno(file)] = 0; \
      done = real(file); \
      late(is_hit); \
      return fails(is_hit) ? EOF : done; \
   }
ON_FILE(fflush)
ON_FILE(fclose)

int close(int descriptor)
{
   REAL(int, "close", int);
   int is_hit = is_watched(descriptor) && hit("close", "");
   int done;

   if (descriptor >= 0 && descriptor < MOST)
      watched[descriptor] = 0;
   done = real(descriptor);
   late(is_hit);
   return fails(is_hit) ? -1 : done;
}

#define ON_DESCRIPTOR(name, type, more, ...) \
   int name(int descriptor more) \
   { \
      REAL(int, #name, int __VA_ARGS__); \
      int is_hit = is_watched(descriptor) && hit(#name, ""); \
      int done; \
      if (fails(is_hit)) \
         return -1; \
      done = CALL; \
      late(is_hit); \
      return done; \
   }
#undef CALL
#define CALL real(descriptor)
ON_DESCRIPTOR(fsync, int, )
ON_DESCRIPTOR(fdatasync, int, )
#undef CALL
#define CALL real(descriptor, more)
ON_DESCRIPTOR(ftruncate, int, COMMA off_t more, COMMA off_t)
ON_DESCRIPTOR(ftruncate64, int, COMMA off_t more, COMMA off_t)
ON_DESCRIPTOR(flock, int, COMMA int more, COMMA int)

#define ON_PATH(name, parameters, arguments, types) \
   int name parameters \
   { \
      static int (*real) types; \
      int is_hit, done; \
      if (real == NULL) \
         real = (int (*) types)dlsym(RTLD_NEXT, #name); \
      is_hit = below(path) && hit(#name, path); \
      if (fails(is_hit)) \
         return -1; \
      done = real arguments; \
      late(is_hit); \
      return done; \
   }
ON_PATH(rename, (const char *path, const char *to), (path, to), (const char *, const char *))
ON_PATH(link, (const char *path, const char *to), (path, to), (const char *, const char *))
ON_PATH(unlink, (const char *path), (path), (const char *))
ON_PATH(mkdir, (const char *path, mode_t mode), (path, mode), (const char *, mode_t))
ON_PATH(rmdir, (const char *path), (path), (const char *))
ON_PATH(truncate, (const char *path, off_t length), (path, length), (const char *, off_t))

/* Allocations: malloc_usable_size and the like stay those of the C library. */
extern void *__libc_malloc(size_t);
extern void *__libc_calloc(size_t, size_t);
extern void *__libc_realloc(void *, size_t);

static int too_large(size_t bytes)
{
   char number[24];

   if (large == 0 || !is_ready || bytes < (size_t)large)
      return 0;
   snprintf(number, sizeof number, "%zu", bytes);
   return hit("malloc", number);
}

void *malloc(size_t bytes)
{
   if (too_large(bytes)) {
      errno = ENOMEM;
      return NULL;
   }
   return __libc_malloc(bytes);
}

void *calloc(size_t count, size_t bytes)
{
   if (bytes > 0 && count > 0 && too_large(count * bytes)) {
      errno = ENOMEM;
      return NULL;
   }
   return __libc_calloc(count, bytes);
}

void *realloc(void *old, size_t bytes)
{
   if (too_large(bytes)) {
      errno = ENOMEM;
      return NULL;
   }
   return __libc_realloc(old, bytes);
}
