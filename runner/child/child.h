/* Other programs that a command runs: found, started, watched, ended.
 *
 * The room child holds this alone. Workers are started by parent/. */
#ifndef FM_CHILD_H
#define FM_CHILD_H

#include <stdbool.h>
#include <stdint.h>
#include <sys/types.h>

#include "base/error.h"

/* Path of a program in PATH. FM_UNSUPPORTED: it is not there, with Debian's package that has it. */
fm_status child_find(char *path, size_t room_bytes, const char *name, const char *package,
                     fm_error *err);

typedef struct fm_child_desc {
    const char *path;
    char *const *argv;        /* ends with NULL */
    const char *const *added; /* "NAME=VALUE" over our environment, in place of
                               * what has the name; ends with NULL; may be NULL */
    const char *log;          /* file that its stdout and stderr are appended to */
    const char *folder;       /* it works in; NULL: ours. `path` is seen from it */
    int kept_fd;              /* stays open under the same number; 0: none */
} fm_child_desc;

/* A process in a group of its own, which dies with us. */
fm_status child_start(pid_t *pid, const fm_child_desc *desc, fm_error *err);
/* Waits until it has ended, `until` exists (NULL: never), or seconds have passed; then ends its
 * group. true: it had ended by itself, with *code (128 + n: by signal n). */
bool child_wait(int *code, pid_t pid, double seconds, const char *until);
/* Ends its group, first politely. pid 0: nothing. */
void child_end(pid_t pid);

#endif
