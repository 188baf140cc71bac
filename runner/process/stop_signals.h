/* The signals that ask this process to stop: SIGINT, SIGTERM, SIGHUP. While they are open they are
 * blocked and read from a descriptor, so that no handler, and no state that a handler could reach,
 * is needed. One that was ignored before stays ignored: SIGINT of a shell's background job, SIGHUP
 * under nohup. */
#ifndef FM_STOP_SIGNALS_H
#define FM_STOP_SIGNALS_H

#include <signal.h>

#include "base/error.h"

typedef struct fm_stop_signals {
    sigset_t previous; /* mask, as it was before */
    int fd;            /* readable when one has come */
} fm_stop_signals;

/* FM_IO: no descriptor is left. */
fm_status stop_signals_open(fm_stop_signals *signals, fm_error *err);
/* Signals that arrived meanwhile are dropped: who opened has heard the first one. */
void stop_signals_close(fm_stop_signals *signals);

/* The next of them, waited for so long; 0: none came. */
int stop_signals_next(const fm_stop_signals *signals, double seconds);

#endif
