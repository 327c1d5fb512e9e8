/* Ctrl-C while histories run: a handler that takes note of the signal and passes it on. Fortran knows no signals. */
#include <signal.h>
#include <stddef.h>

static volatile sig_atomic_t noted, listening;
static struct sigaction before;

static void note(int number, siginfo_t *info, void *context)
{
   noted = 1;
   if (before.sa_flags & SA_SIGINFO)
      before.sa_sigaction(number, info, context);
   else
      before.sa_handler(number);
}

/* Listen to SIGINT. A program that ignores it or dies of it goes on to do so. */
void dondolo_listen(void)
{
   struct sigaction ours;

   noted = 0;
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
   noted = 0;
}

/* 1: the signal has come since listening began */
void dondolo_look_for_interrupt(int *is_noted)
{
   *is_noted = noted;
}
