/* The guard of a process: process.h says what for. For process.c alone. */
#ifndef FM_GUARD_H
#define FM_GUARD_H

#include "process.h"

/* What comes through the pipe `report`. Two come where the process could not be executed: the first
 * is its own, with the error. */
typedef struct guard_report {
    int error;       /* an errno: it was not started; 0: it was */
    int wait_status; /* where it was */
    uint64_t peak_bytes;
} guard_report;

typedef struct guard_desc {
    const fm_process_desc *process;
    const sigset_t *mask; /* of signals, for the process */
    int input, talk;      /* its stdin; its stdout and stderr */
    int control;          /* readable, or at its end: all are to be ended */
    int report;           /* where a guard_report goes to */
} guard_desc;

/* In a fork of the process that waits: starts the process, and ends with it. */
_Noreturn void guard_main(const guard_desc *desc);

#endif
