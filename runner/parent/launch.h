/* One launch: a worker process, started, limited, watched, ended with all that it started. */
#ifndef FM_LAUNCH_H
#define FM_LAUNCH_H

#include <jansson.h>
#include <stdbool.h>
#include <stdint.h>

#include "base/error.h"
#include "model/outcome.h"
#include "process/stop_signals.h"

typedef struct fm_launch_desc {
    const char *worker;    /* executable; NULL: this program */
    const char *request;   /* path of a file that exists */
    const char *result;    /* path that the worker writes; removed before it starts */
    const char *log;       /* path that its stdout and stderr are appended to: the beginning and
                              the end, LAUNCH_LOG_BYTES in all */
    const char *input;     /* file that its scene reads, named if it dies; NULL: none */
    uint32_t frames;       /* that its answer may speak of: answer_check.h */
    uint32_t timeout_s;    /* 0: none */
    uint64_t memory_bytes; /* address space; 0: no limit */
    void (*tick)(void *context); /* about once a second; NULL: none */
    void *context;
} fm_launch_desc;

#define LAUNCH_LOG_BYTES ((uint64_t)1 << 20)

/* How it went. Who is to blame for a death is for whoever can compare two of them. */
typedef enum fm_launch_kind {
    FM_LAUNCH_ANSWERED,    /* result is the worker's; or "timeout"; or it says that the run is at
                              fault: the answer cannot be written, or a limit that the run was given
                              (ulimit) ended the worker */
    FM_LAUNCH_DIED,        /* no answer, or nonsense: result is "crash" or "out_of_memory" */
    FM_LAUNCH_KILLED,      /* by SIGKILL, SIGTERM, SIGINT or SIGHUP, which we did not send, and the
                              kernel did not for want of memory: result is "crash" */
    FM_LAUNCH_INTERRUPTED, /* by a signal that stops us, perhaps after the worker had it; no result
                            */
} fm_launch_kind;

typedef struct fm_launch_outcome {
    fm_launch_kind kind;
    int stop_signal; /* the one that interrupted it; else 0 */
    json_t *result;  /* as protocol.h says; owned by the caller */
    double seconds;
} fm_launch_outcome;

/* Runs one worker to its end.
 * FM_IO, FM_INVALID: nothing could be started, or its log cannot be written. */
fm_status launch_worker(fm_launch_outcome *outcome, const fm_stop_signals *signals,
                        const fm_launch_desc *desc, fm_error *err);

#endif
