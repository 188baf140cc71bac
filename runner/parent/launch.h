/* One worker process: started, limited, watched, reaped.
 *
 * While a launcher is open, SIGCHLD, SIGINT and SIGTERM are blocked and taken by sigtimedwait, so
 * that no handler, and no state that a handler could reach, is needed. */
#ifndef FM_LAUNCH_H
#define FM_LAUNCH_H

#include <jansson.h>
#include <signal.h>
#include <stdbool.h>
#include <stdint.h>

#include "base/error.h"
#include "model/outcome.h"

typedef struct fm_launcher {
    sigset_t watched, previous;
    struct sigaction child_action; /* as it was before */
} fm_launcher;

typedef struct fm_launch_desc {
    const char *worker;          /* executable; NULL: this program */
    const char *request;         /* path of a file that exists */
    const char *result;          /* path that the worker writes; removed before it starts */
    const char *log;             /* path that its stdout and stderr are appended to */
    const char *input;           /* file that its scene reads, named if it dies; NULL: none */
    uint32_t frames;             /* that its answer may speak of: answer_check.h */
    uint32_t timeout_s;          /* 0: none */
    uint64_t memory_bytes;       /* address space; 0: no limit */
    void (*tick)(void *context); /* about once a second; NULL: none */
    void *context;
} fm_launch_desc;

typedef struct fm_launch_outcome {
    bool is_interrupted; /* the worker was stopped because we were told to stop */
    int stop_signal;     /* the signal that told us so: SIGINT or SIGTERM */
    json_t *result;      /* as protocol.h says; made up when the worker left none. Owned by the
                            caller; NULL when interrupted */
    double seconds;
} fm_launch_outcome;

void launcher_open(fm_launcher *launcher);
/* Signals that arrived meanwhile are dropped: the run has heard the first one. */
void launcher_close(const fm_launcher *launcher);
/* SIGINT or SIGTERM if one came since the last look, else 0. */
int launcher_stop_signal(const fm_launcher *launcher);

/* Runs one worker to its end. A worker that crashes, hangs, or answers nonsense is an outcome with
 * status "crash", "timeout" or "out_of_memory", not an error.
 * FM_IO, FM_INVALID: nothing could be started. */
fm_status launch_worker(fm_launch_outcome *outcome, const fm_launcher *launcher,
                        const fm_launch_desc *desc, fm_error *err);

#endif
