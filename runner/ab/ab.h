/* Two builds of a method, or of many, compared by pairs of launches.
 *
 * DIRECTORY/base and DIRECTORY/new are runs like any other (parent/run.h), whose launches take
 * turns: of each pair one launch each, BASE or NEW first by turns, the cases in a seeded order.
 * Their journals are what a killed process continues from: what was measured is replayed, and gives
 * the same decisions. `fragmark compare DIRECTORY/base DIRECTORY/new` reads them, too. Beside them
 * lie pairs.csv, a row a pair, and ab.csv, a row a case. */
#ifndef FM_AB_H
#define FM_AB_H

#include <jansson.h>
#include <stdio.h>

#include "looks.h"
#include "noise.h"
#include "outputs.h"
#include "parent/run.h"
#include "sides.h"

/* The program that measures a side. Zero: this one. All borrowed. */
typedef struct ab_program {
    const char *path, *commit, *compiler; /* as worker, worker_commit, ... of fm_run_desc */
} ab_program;

/* All borrowed. */
typedef struct ab_desc {
    const char *directory;         /* made */
    const char *command;           /* for the manifests */
    fm_plan *plans[AB_SIDE_COUNT]; /* launches are set here, and reasons to skip cases */
    const fm_plugin_list *plugins[AB_SIDE_COUNT];
    const ab_policy *policy;
    const ab_noise_list *noise; /* NULL: none */
    fm_run_desc run; /* limits, validation, progress and talk of both runs; what else is in it is
                        set here */
    ab_program programs[AB_SIDE_COUNT]; /* whose workers measure */
} ab_desc;

typedef struct ab_case {
    const fm_case *planned[AB_SIDE_COUNT]; /* of the plans, which outlive it */
    char name[256];                        /* of BASE's case */
    char device_name[128];
    double *numbers[AB_SIDE_COUNT][AB_STATISTIC_COUNT]; /* [pair_room], ms; NAN: none; owned */
    double *differences[AB_STATISTIC_COUNT]; /* [pair_room]: log of NEW over BASE; owned */
    ab_tested tested;
    ab_outputs outputs;
    fm_text changes; /* of the outputs; owned */
    fm_case_status status[AB_SIDE_COUNT];
    char message[AB_SIDE_COUNT][512];
    ab_verdict verdict; /* of outputs and statistics together */
} ab_case;

typedef struct ab_result {
    ab_case *cases; /* [count]; owned */
    size_t count;
    ab_pairs pairs;
    uint64_t seed;           /* of which side of a pair is first, and of the order of cases */
    uint32_t pair_room;      /* of a case */
    uint32_t confirm_first;  /* pairs from here on are of the confirmation */
    uint32_t measured_pairs; /* of all cases, by this process and earlier ones */
    bool is_finished;        /* else a signal came, and cases may have no verdict yet */
    int stop_signal;
    bool is_damaged, is_other_code; /* as of the run that failed */
} ab_result;

/* Measures, judges, and writes both files. FM_OK also where a signal stopped it, or methods failed.
 * FM_INVALID: no case in both plans, or as run_cases, with "base: " or "new: " before it; FM_IO:
 * the same; FM_NO_MEMORY. The caller frees, after a failure too. */
fm_status ab_run(ab_result *result, const ab_desc *desc, fm_error *err);
void ab_free(ab_result *result);

size_t ab_count(const ab_result *result, ab_verdict verdict);
/* What a reader is told beside a verdict: "confirmed on 20 fresh pairs", "60 pairs might decide",
 * a status' message; "": nothing. */
void ab_why(fm_text *why, const ab_case *of, const ab_policy *policy);

/* What is printed: a line a case, the worst first, and a summary. */
void ab_add_lines(fm_text *text, const ab_result *result, const ab_policy *policy);
/* A row a case, as ab.csv. */
void ab_add_csv(fm_text *csv, const ab_result *result, const ab_policy *policy);
/* A row a pair, as pairs.csv: numbers of all that were measured. */
void ab_add_pairs(fm_text *csv, const ab_result *result);
/* The same as ab_add_csv, with the policy. NULL: no memory. */
json_t *ab_json(const ab_result *result, const ab_policy *policy);

#endif
