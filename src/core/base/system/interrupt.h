/* What a thread looks at now and then, to see whether its work should end early */
#ifndef DONDOLO_INTERRUPT_H
#define DONDOLO_INTERRUPT_H

struct dondolo_watched {
   int since;                /* how many signals had come when it began to listen; -1: it does not listen */
   const volatile int *flag; /* not 0 once another thread wants it to end; NULL: there is none */
};

/* Let this thread listen from this number of signals on; -1: no more */
void dondolo_watch_signals(int since);

/* How many signals have come */
int dondolo_signals_come(void);

#endif
