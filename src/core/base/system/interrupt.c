/* Signals while histories run: handlers that take note of them. Fortran knows no signals. For Windows see
   windows_process.c; what threads listen for is in watched.c. */
#ifndef _WIN32
#include "interrupt.h"
#include <signal.h>
#include <stddef.h>

/* The last signal, and how many have come; what comes is never taken back, so that no thread can miss it */
static volatile sig_atomic_t noted, come, listening;
static struct sigaction before;

static void note(int number, siginfo_t *info, void *context)
{
   noted = number;
   come = come + 1;
   if (before.sa_flags & SA_SIGINFO)
      before.sa_sigaction(number, info, context);
   else
      before.sa_handler(number);
}

/* Let this thread listen to SIGINT. A program that ignores it or dies of it goes on to do so. */
void dondolo_listen(void)
{
   struct sigaction ours;

   dondolo_watch_signals(come);
   if (listening || sigaction(SIGINT, NULL, &before) != 0)
      return;
   if (!(before.sa_flags & SA_SIGINFO) && (before.sa_handler == SIG_DFL || before.sa_handler == SIG_IGN))
      return;
   ours = before;
   ours.sa_flags |= SA_SIGINFO;
   ours.sa_sigaction = note;
   listening = sigaction(SIGINT, &ours, NULL) == 0;
}

/* Listen no more: the handler from before is back. */
void dondolo_end_listening(void)
{
   if (listening)
      sigaction(SIGINT, &before, NULL);
   listening = 0;
   dondolo_watch_signals(-1);
}

static void remember(int number)
{
   noted = number;
   come = come + 1;
}

/* A program of its own ends in order when it is interrupted (SIGINT), terminated (SIGTERM) or its terminal is gone
   (SIGHUP), and at once at the second signal. What it was started to ignore, as nohup does, it ignores. */
void dondolo_end_in_order(void)
{
   static const int numbers[] = {SIGINT, SIGTERM, SIGHUP};
   struct sigaction ours, theirs;

   dondolo_watch_signals(come);
   ours.sa_handler = remember;
   ours.sa_flags = SA_RESTART | SA_RESETHAND;
   sigemptyset(&ours.sa_mask);
   for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++)
      if (sigaction(numbers[i], NULL, &theirs) == 0 && theirs.sa_handler == SIG_DFL)
         sigaction(numbers[i], &ours, NULL);
}

/* Die of the signal that was noted, so that whoever started the program sees it */
void dondolo_die_of_signal(void)
{
   if (noted == 0)
      return;
   signal(noted, SIG_DFL);
   raise(noted);
}

int dondolo_signals_come(void)
{
   return come;
}
#endif
