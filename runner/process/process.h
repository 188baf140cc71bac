/* Processes of this program's own making: started with limits, watched, and ended together with all
 * that they started.
 *
 * Between this process and the one that it starts stands a guard, a fork of this process. The
 * kernel hands it whatever the started process leaves behind, so that nothing outlives the call:
 * not what has left the group or the session, not what was forked twice. The guard ends them all
 * when the started process has ended, when it is to be stopped, and when this process is gone, be
 * it by SIGKILL. It is in a group of its own and blocks all signals. Limits: who kills the guard
 * itself by SIGKILL ends the started process with it, but not what that has started; and processes
 * that the kernel cannot end, or that fork faster than they are ended, are left after
 * GUARD_PATIENCE_S.
 *
 * A started process has /dev/null as its input; its output and its errors go through a pipe, of
 * which a log keeps the beginning and the end. It dumps no core, and a write beyond a limit on
 * files is an error for it (EFBIG) instead of its death. It inherits no descriptor, if ours are all
 * O_CLOEXEC.
 *
 * The room process knows nothing of fragmark. This process must have one thread only. */
#ifndef FM_PROCESS_H
#define FM_PROCESS_H

#include <stdbool.h>
#include <stdint.h>

#include "base/error.h"
#include "limits.h"
#include "stop_signals.h"

enum {
    PROCESS_WORDS_BYTES = 2000, /* of the last words that are kept */
    GUARD_PATIENCE_S = 10       /* with processes that do not die */
};

typedef struct fm_process_desc {
    const char *path;        /* executable; NULL: this program */
    const char *const *argv; /* ends with NULL */
    const char *log;         /* file that its output is appended to, made with the first byte; NULL:
                                none */
    uint64_t log_bytes; /* what the file may hold; more is dropped, but for the last words; 0: no
                           limit */
    int kept_fd;        /* stays open in it under the same number; 0: none */
    fm_process_limits limits;
    double timeout_s;            /* 0: none */
    void (*tick)(void *context); /* about once a second; NULL: none */
    void *context;
} fm_process_desc;

/* How a process ended. */
typedef struct fm_process_end {
    int wait_status;     /* of waitpid; SIGKILL also where the guard was killed */
    int stop_signal;     /* one of ours that came while it ran: it was ended for it; 0: none */
    bool is_timed_out;   /* it was ended for it */
    uint64_t peak_bytes; /* resident */
    double seconds;
    /* The end of what it wrote, with a NUL. */
    char words[PROCESS_WORDS_BYTES + 1];
} fm_process_end;

/* Runs a process to its end, whatever that is. signals: those that end it; NULL: none.
 * FM_INVALID: path cannot be executed by us. FM_IO: it could not be started, for want of processes,
 * memory or descriptors say, or its log could not be written; the message has the reason. */
fm_status process_run(fm_process_end *end, const fm_stop_signals *signals,
                      const fm_process_desc *desc, fm_error *err);

#endif
