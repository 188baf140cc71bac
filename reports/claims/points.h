/* Points of a claim: values with intervals, one for each row of `of`, and how they relate. */
#ifndef FM_CLAIM_POINTS_H
#define FM_CLAIM_POINTS_H

#include "match.h"
#include "read/interval.h"

typedef struct fm_claim_point {
    fm_interval value;
    double x;                  /* of `along`; NAN: there is none */
    const fm_case_row *result; /* of `of`; NULL: a row of memory.csv */
    const fm_case_row *other;  /* of `over`; may be NULL */
    size_t row;                /* of memory.csv */
    size_t selection;          /* index in `of` */
    bool is_incomplete;        /* of several rows to compare with, some have no value */
} fm_claim_point;

typedef struct fm_claim_points {
    fm_claim_point *points; /* owned */
    size_t count, capacity;
    bool failed;       /* out of memory while points were added */
    char missing[256]; /* why rows gave no point: the first reason; "": none was missing */
    size_t missing_count;
    char incomplete[256]; /* why points are incomplete: the first reason */
} fm_claim_points;

/* Adds a point. Out of memory is remembered in `failed`. */
void claim_points_add(fm_claim_points *points, const fm_claim_point *point);
/* Brings the points of each series together, x rising. */
void claim_points_sort(fm_claim_points *points, const fm_claim *claim);
void claim_points_free(fm_claim_points *points);

/* Points of one curve: they differ in `along` and `across` only. */
bool claim_point_same_series(const fm_claim *claim, const fm_claim_point *a,
                             const fm_claim_point *b);
/* The same workload, whatever the method; where seeds are joined, whatever the seed, too. */
bool claim_point_same_workload(const fm_claim *claim, const fm_claim_point *a,
                               const fm_claim_point *b);
/* "K+B-Array, k 8, n 128": tells a point from the others. used: [results->count], the cases of all
 * points; NULL: the title alone. */
void claim_point_name(char name[160], const fm_claim_rows *rows, const bool *used,
                      const fm_claim_point *point);

#endif
