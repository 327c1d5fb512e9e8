/* What processes need of the system: the path of their own program, to become another one, and how much memory they may
   have. For Windows see windows_process.c. */
#ifndef _WIN32
#define _GNU_SOURCE
#include "standard.h"
#include <signal.h>
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

/* Settle what a program of its own may meet: where a file would grow beyond the limit of the process (ulimit -f), writing fails
   as on a full disk. */
void dondolo_set_up_process(void)
{
#ifdef SIGXFSZ
   signal(SIGXFSZ, SIG_IGN);
#endif
}

/* 1: a file descriptor is a terminal */
int dondolo_is_terminal(int descriptor)
{
   return isatty(descriptor);
}

/* Words that a NUL ends each, as a program gets them; NULL: too little memory */
static char **take_words(char *words, int count)
{
   char **arguments = calloc((size_t)count + 1, sizeof *arguments);

   for (int i = 0; arguments != NULL && i < count; i++) {
      arguments[i] = words;
      words += strlen(words) + 1;
   }
   return arguments;
}

/* Become Python, with its name and arguments in words that a NUL ends each. Returns only if there is none. */
void dondolo_become(char *words, int count)
{
   char **arguments = take_words(words, count), *modules = dondolo_modules_elsewhere(':');

   if (arguments == NULL)
      return;
   if (modules != NULL && *modules != '\0')
      setenv("PYTHONPATH", modules, 1);
   else if (modules != NULL)
      unsetenv("PYTHONPATH");
   free(modules);
   execvp(arguments[0], arguments);
   free(arguments);
}

/* Begin again, with the same words, with threads of OpenMP that sleep while they wait. OpenMP reads the policy before a program
   begins. Returns if somebody has chosen a policy, as this has the second time, or if the program cannot begin again. */
void dondolo_sleep_while_waiting(char *words, int count)
{
   char path[8192], **arguments;

   if (getenv("OMP_WAIT_POLICY") != NULL || getenv("GOMP_SPINCOUNT") != NULL)
      return;
   dondolo_own_path(path, sizeof path);
   arguments = take_words(words, count);
   if (arguments != NULL && path[0] != '\0' && setenv("OMP_WAIT_POLICY", "passive", 1) == 0)
      execv(path, arguments);
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

/* No console ends with a program of POSIX. */
void dondolo_hold_console(const char *text)
{
   (void)text;
}

void dondolo_receive_file(const char *path)
{
   (void)path;
}
#endif
