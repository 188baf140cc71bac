/* A night at work, and the programs that it executes. */
#ifndef FM_NIGHTLY_TONIGHT_H
#define FM_NIGHTLY_TONIGHT_H

#include "cli/cli.h"
#include "policy.h"
#include "state.h"

typedef struct fm_tonight {
    const fm_cli *cli;
    const fm_policy *policy;
    int lock; /* a file that is locked; what the night executes holds it, too */
    fm_night_state night;
    bool is_continued; /* an earlier process began it */
    const char **argv; /* with which this program was executed; ends with NULL */
} fm_tonight;

/* So long a night that is continued may work at least, however late it is. */
#define TONIGHT_LEAST_S 20.0

/* Add `option VALUE` for each value, or for one. false: no memory. */
bool tonight_add_all(fm_text_list *argv, const char *option, const fm_text_list *values);
bool tonight_add_two(fm_text_list *argv, const char *option, const char *value);

/* What is executed, and how it ended. */
typedef struct fm_night_program {
    const char *path;   /* NULL: this program */
    const char *folder; /* in which it works; NULL: ours */
    const char *log;    /* its output: NIGHT/LOG */
    double seconds;     /* at most */
} fm_night_program;
typedef struct fm_night_end {
    int code;        /* 128 + n: by signal n */
    bool is_cut_off; /* its time was over */
    double seconds;
} fm_night_end;
/* FM_IO, FM_NO_MEMORY: it could not be started. */
fm_status tonight_execute(fm_night_end *end, const fm_tonight *tonight, const fm_text_list *argv,
                          const fm_night_program *program, fm_error *err);

#endif
