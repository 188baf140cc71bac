/* What ab, gate and calibrate share: their options, and two sides that become one comparison. */
#ifndef FM_REGRESS_COMPARING_H
#define FM_REGRESS_COMPARING_H

#include "ab/ab.h"
#include "cli/cli.h"

typedef struct comparing_arguments {
    fm_arguments selection;       /* what is measured, and how it is run */
    const char *spec;             /* NULL: none */
    uint32_t looks[AB_LOOKS + 1]; /* ends with 0; none: ab_policy_make's */
    double band;                  /* 0: ab_policy_make's */
    const char *calibration;      /* a file, or "none"; NULL: that of this machine */
    const char *csv;              /* also write the table here; NULL: not asked for */
} comparing_arguments;

/* --pairs, --band, --calibration, --csv, --json, --spec; its input is comparing_arguments. */
extern const struct argp comparing_argp;

/* Both sides, opened. Zero it. */
typedef struct comparing {
    const comparing_arguments *given;
    char folders[AB_SIDE_COUNT][FM_PATH_MAX_BYTES]; /* of plugins */
    fm_text_list methods[AB_SIDE_COUNT];            /* that are compared */
    fm_plan plans[AB_SIDE_COUNT];
    fm_plugin_list plugins[AB_SIDE_COUNT];
    ab_policy policy;
    ab_noise_list noise;
    char directory[FM_PATH_MAX_BYTES]; /* of the results */
    ab_result result;
} comparing;

/* Where nothing is said of scenes, axes or a spec: a case that a software rasteriser draws in a
 * fifth of a second. Where nothing is said of frames: 20 of a launch. FM_NO_MEMORY. */
fm_status comparing_use_defaults(comparing_arguments *given, fm_error *err);
/* Finds the plugins of a side; folders[side] is set. */
fm_status comparing_find(comparing *of, ab_side_name side, fm_error *err);
/* Expands both sides' methods to plans, and makes the policy. FM_INVALID: unknown names, a method
 * that is not in its side's folder, -a launches. */
fm_status comparing_plan(comparing *of, fm_error *err);
/* Reads the calibration, if there is one. */
fm_status comparing_read_noise(comparing *of, fm_error *err);
/* Measures and judges: ab_run. command: for the manifests. */
fm_status comparing_run(comparing *of, const char *command, fm_error *err);
/* Prints the verdicts as asked for, and returns the exit code; status: of comparing_run. */
int comparing_report(const comparing *of, fm_status status, const fm_error *err);
void comparing_free(comparing *of);

#define COMPARING_EXIT_CODES                                                                       \
    "Exit codes: 0 nothing is worse; 1 a case is worse, confirmed on fresh launches or by its "    \
    "outputs; 2 usage or spec error, nothing was run; 3 nothing could be measured; 4 some cases "  \
    "failed on both sides; 5 incomplete: the same command with the same -o continues; 7 other "    \
    "code than launches were begun with; 8 damaged or foreign file; 129, 130, 143 interrupted: "   \
    "the same command with the same -o continues."

#endif
