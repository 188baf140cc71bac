/* What ab, gate and calibrate share: their options, and two sides that become one comparison. */
#ifndef FM_REGRESS_COMPARING_H
#define FM_REGRESS_COMPARING_H

#include "ab/ab.h"
#include "cli/cli.h"
#include "describe/describe.h"
#include "program/program.h"

typedef struct comparing_arguments {
    fm_arguments selection;       /* what is measured, and how it is run */
    const char *spec;             /* NULL: none */
    fm_text_list cases;           /* ids: these alone; none: all */
    uint32_t looks[AB_LOOKS + 1]; /* ends with 0; none: ab_policy_make's */
    double band;                  /* 0: ab_policy_make's */
    const char *calibration;      /* a file, or "none"; NULL: that of this machine */
    char *csv;                    /* also write the table here; NULL: not asked for */
    bool is_by_this_program;      /* both sides; else each by its build's own, if it has one */
} comparing_arguments;

/* --pairs, --band, --calibration, --csv, --json, --spec, --case, --program; its input is
 * comparing_arguments. */
extern const struct argp comparing_argp;

/* Both sides, opened. Zero it. */
typedef struct comparing {
    const comparing_arguments *given;
    fm_build builds[AB_SIDE_COUNT];
    fm_describer describers[AB_SIDE_COUNT]; /* their programs */
    fm_text_list methods[AB_SIDE_COUNT];    /* that are compared */
    fm_plan plans[AB_SIDE_COUNT];
    fm_plugin_list plugins[AB_SIDE_COUNT];
    ab_policy policy;
    ab_noise_list noise;
    char directory[FM_PATH_MAX_BYTES]; /* of the results */
    ab_result result;
    bool has_foreign_program; /* a side's own cannot measure for this one */
} comparing;

/* Where nothing is said of scenes, axes or a spec: a case that a software rasteriser draws in a
 * fifth of a second. Where nothing is said of frames: 20 of a launch. FM_NO_MEMORY. */
fm_status comparing_use_defaults(comparing_arguments *given, fm_error *err);
/* Takes the build at `path` for a side: its plugins, and its own program, which is asked whether it
 * can measure for this one. FM_INVALID: has_foreign_program; it has a program and no shaders of the
 * runner; no plugins. FM_IO: it is no folder. */
fm_status comparing_open(comparing *of, ab_side_name side, const char *path, fm_error *err);
/* Expands both sides' methods to plans, and makes the policy. FM_INVALID: unknown names, a method
 * that is not in its side's folder, -a launches. */
fm_status comparing_plan(comparing *of, fm_error *err);
/* Reads the calibration, if there is one. */
fm_status comparing_read_noise(comparing *of, fm_error *err);
/* Measures and judges: ab_run. command: for the manifests. */
fm_status comparing_run(comparing *of, const char *command, fm_error *err);
/* Says why nothing was measured, and returns the exit code: what failed before comparing_run. */
int comparing_refuse(const comparing *of, const fm_error *err);
/* Prints the verdicts as asked for, and returns the exit code; status: of comparing_run. */
int comparing_report(const comparing *of, fm_status status, const fm_error *err);
/* Says why comparing_run failed, and returns the exit code. */
int comparing_fail(const comparing *of, const fm_error *err);
/* Whether a case failed on either side. */
bool comparing_has_failures(const comparing *of);
void comparing_free(comparing *of);
void comparing_arguments_free(comparing_arguments *given);

#define COMPARING_EXIT_CODES                                                                       \
    "Exit codes: 0 nothing is worse; 1 a case is worse, confirmed on fresh launches or by its "    \
    "outputs; 2 usage or spec error, nothing was run; 3 nothing could be measured; 4 some cases "  \
    "failed on both sides; 5 incomplete: the same command with the same -o continues; 7 other "    \
    "code than launches were begun with, or a build whose program does not measure for this one; " \
    "8 damaged or foreign file; 129, 130, 143 interrupted: the same command with the same -o "     \
    "continues."

#endif
