/* What a thread looks at now and then, to see whether its work should end early */
#ifndef DONDOLO_INTERRUPT_H
#define DONDOLO_INTERRUPT_H

struct dondolo_watched {
   int since;                /* how many signals had come when it began to listen; -1: it does not listen */
   const volatile int *flag; /* not 0 once another thread wants it to end; NULL: there is none */
};

#endif
