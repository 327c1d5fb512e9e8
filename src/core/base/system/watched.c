/* What ends the work of a thread, on every system: signals, which interrupt.c and windows_process.c count, and a flag. */
#include "interrupt.h"
#include <stddef.h>

static _Thread_local struct dondolo_watched watched = {-1, NULL};

void dondolo_watch_signals(int since)
{
   watched.since = since;
}

/* End the work of this thread once a number, which another thread writes, is not 0; NULL: no more */
void dondolo_stop_at(const volatile int *flag)
{
   watched.flag = flag;
}

/* What this thread listens for, which is handed to those that work for it */
void dondolo_get_watched(struct dondolo_watched *own)
{
   *own = watched;
}

/* Listen for what another thread listens for */
void dondolo_watch(const struct dondolo_watched *other)
{
   watched = *other;
}

/* 1: a signal has come since this thread, or the one that it works for, began to listen, or its flag is set */
void dondolo_look_for_interrupt(int *is_noted)
{
   *is_noted = (watched.since >= 0 && dondolo_signals_come() != watched.since) || (watched.flag != NULL && *watched.flag != 0);
}
