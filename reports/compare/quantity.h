/* What is compared of each case: a time, or a time over another one of the same run. */
#ifndef FM_COMPARE_QUANTITY_H
#define FM_COMPARE_QUANTITY_H

#include "base/stats.h"
#include "machines.h"
#include "read/result_files.h"

typedef enum fm_quantity_over {
    FM_OVER_NOTHING, /* the time itself */
    FM_OVER_FLOOR,   /* over the floor's of the same launch (launches.h) */
    FM_OVER_METHOD   /* over a named method's on the same workload */
} fm_quantity_over;

/* The cases of one run that others are taken over: measured, with all options at their defaults. */
typedef struct fm_references {
    const fm_result_files *run;
    size_t *cases; /* [count]: their numbers in run->cases; owned */
    size_t count;
} fm_references;

typedef struct fm_quantity {
    const char *metric; /* frame_ms, ...; less is better */
    fm_quantity_over over;
    const char *method;          /* OVER_METHOD: its id */
    fm_references references[2]; /* OVER_METHOD: of either run */
    bool is_chosen;              /* nobody asked for `over`: machines or days differ */
} fm_quantity;

/* What was asked for. */
typedef struct fm_quantity_desc {
    const char *metric;    /* a time of frames, or times_floor; NULL: frame_ms */
    const char *reference; /* "none", "floor" or a method; NULL: none where both runs are of one
                              machine and day, or if a metric is named; else floor */
} fm_quantity_desc;

/* Decides what is compared. Texts of desc are borrowed. FM_INVALID: no such metric or method, with
 * the nearest; FM_UNSUPPORTED: milliseconds of two machines; FM_NO_MEMORY. The caller frees, after
 * a failure too. */
fm_status quantity_choose(fm_quantity *quantity, const fm_quantity_desc *desc,
                          const fm_machines *machines, const fm_result_files *base,
                          const fm_result_files *now, fm_error *err);

void quantity_free(fm_quantity *quantity);

/* Whether others may be taken over this case: it was measured, with all options at their defaults.
 */
bool quantity_is_reference(const fm_case_row *row);

/* "frame_ms", "frame_ms / floor", "frame_ms / ab-ll" */
void quantity_title(char title[128], const fm_quantity *quantity);

/* Of a case of one of the two runs, with its 95 % interval by launches; all NAN: it was not
 * measured, or has no such time, or, OVER_METHOD, the run has no such case of that method: its
 * options are at their defaults, its k is the same or none, all else is the same. */
fm_interval quantity_of(const fm_quantity *quantity, const fm_result_files *results,
                        const fm_case_row *row);

#endif
