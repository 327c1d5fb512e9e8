/* What processes need of the system: the path of their own program, to become another one, and how much memory they may
   have. */
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <unistd.h>
#ifdef __APPLE__
#include <mach-o/dyld.h>
#endif

/* The absolute path of the program that runs, without links; empty if the system does not tell */
void dondolo_own_path(char *path, size_t room)
{
   char *real = NULL;
#ifdef __APPLE__
   char given[4096];
   uint32_t size = sizeof given;

   if (_NSGetExecutablePath(given, &size) == 0)
      real = realpath(given, NULL);
#else
   real = realpath("/proc/self/exe", NULL);
#endif
   if (real != NULL && strlen(real) < room)
      strcpy(path, real);
   else
      path[0] = '\0';
   free(real);
}

/* Take the current folder out of PYTHONPATH, where an empty entry means it too, as in the common PYTHONPATH=$PYTHONPATH:more */
static void leave_current_folder(void)
{
   const char *given = getenv("PYTHONPATH");
   char *kept, *end;

   if (given == NULL || (kept = malloc(strlen(given) + 1)) == NULL)
      return;
   end = kept;
   for (const char *entry = given; entry != NULL;) {
      const char *colon = strchr(entry, ':');
      size_t length = colon == NULL ? strlen(entry) : (size_t)(colon - entry);

      if (strspn(entry, "./") < length || memcmp(entry, "/", 1) == 0 || strncmp(entry, "..", 2) == 0) {
         if (end > kept)
            *end++ = ':';
         memcpy(end, entry, length);
         end += length;
      }
      entry = colon == NULL ? NULL : colon + 1;
   }
   *end = '\0';
   if (end > kept)
      setenv("PYTHONPATH", kept, 1);
   else
      unsetenv("PYTHONPATH");
   free(kept);
}

/* Become Python, with its name and arguments in words that a NUL ends each. Returns only if there is none. */
void dondolo_become(char *words, int count)
{
   char **arguments = calloc((size_t)count + 1, sizeof *arguments);

   if (arguments == NULL)
      return;
   leave_current_folder();
   for (int i = 0; i < count; i++) {
      arguments[i] = words;
      words += strlen(words) + 1;
   }
   execvp(arguments[0], arguments);
   free(arguments);
}

/* 1: memory may be refused to the process before the machine has used it up: by a limit, as of ulimit -v or -d, or since
   the system promises no more than it has */
int dondolo_is_limited(void)
{
   static const int limits[] = {RLIMIT_AS, RLIMIT_DATA};
   static int promises_all = -1;
   struct rlimit limit;

   if (promises_all < 0) {
      FILE *file = fopen("/proc/sys/vm/overcommit_memory", "r");

      promises_all = file == NULL || fgetc(file) != '2';
      if (file != NULL)
         fclose(file);
   }
   for (size_t i = 0; i < sizeof limits / sizeof *limits; i++)
      if (getrlimit(limits[i], &limit) != 0 || limit.rlim_cur != RLIM_INFINITY)
         return 1;
   return !promises_all;
}
