/* Selections become points: values with intervals, one for each row of `of`. */
#ifndef FM_CLAIM_POINTS_H
#define FM_CLAIM_POINTS_H

#include "read/claim.h"
#include "read/interval.h"
#include "read/result_files.h"

/* Where rows come from. */
typedef struct fm_claim_rows {
    const fm_result_files *results;
    const bool *takes;      /* [results->count]: the figure's own cases; NULL: all */
    const fm_table *memory; /* rows of memory.csv; NULL: none */
    const char *figure;     /* id, for rows of memory.csv */
} fm_claim_rows;

typedef struct fm_claim_point {
    fm_interval value;
    double x;                  /* of `along`; NAN: there is none */
    const fm_case_row *result; /* of `of`; NULL: a row of memory.csv */
    const fm_case_row *other;  /* of `over`; may be NULL */
    size_t row;                /* of memory.csv */
    size_t selection;          /* index in `of` */
    bool has_few_samples;
} fm_claim_point;

typedef struct fm_claim_points {
    fm_claim_point *points; /* owned; sorted by series, then x */
    size_t count;
    char missing[256]; /* why rows gave no point: the first reason; "": none was missing */
    size_t missing_count;
} fm_claim_points;

/* FM_OK also without any point. FM_NO_MEMORY. The caller frees. */
fm_status claim_points_make(fm_claim_points *points, const fm_claim *claim,
                            const fm_claim_rows *rows, fm_error *err);
void claim_points_free(fm_claim_points *points);

/* Points of one curve: they differ in `along` and `across` only. */
bool claim_point_same_series(const fm_claim *claim, const fm_claim_point *a,
                             const fm_claim_point *b);
/* The same workload, whatever the method. */
bool claim_point_same_workload(const fm_claim *claim, const fm_claim_point *a,
                               const fm_claim_point *b);
/* "K+B-Array, k 8, n 128": tells a point from the others. used: [results->count], the cases of all
 * points; NULL: the title alone. */
void claim_point_name(char name[160], const fm_claim_rows *rows, const bool *used,
                      const fm_claim_point *point);

#endif
