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
    bool is_incomplete; /* of several rows to compare with, or of its seeds, some have no value */
} fm_claim_point;

/* A row of `of` that gave no point. */
typedef struct fm_claim_lost {
    fm_claim_point point;     /* without a value */
    const fm_case_row *lacks; /* the row that has none: its own, or the one it is compared with */
    const char *why;          /* borrowed from the results, or static */
    bool is_joined;           /* a point of other seeds tells of it */
} fm_claim_lost;

typedef struct fm_claim_points {
    fm_claim_point *points; /* owned */
    size_t count, capacity;
    fm_claim_lost *lost; /* owned */
    size_t lost_count;
    bool failed;       /* out of memory while points were added */
    char missing[256]; /* why points are missing: the first reason; "": none is */
    size_t missing_count;
    char incomplete[256]; /* why points are incomplete: the first reason */
} fm_claim_points;

/* Adds a point. Out of memory is remembered in `failed`. */
void claim_points_add(fm_claim_points *points, const fm_claim_point *point);
/* Adds a row that gave no point; seeds_join counts it. Out of memory is remembered in `failed`. */
void claim_points_lose(fm_claim_points *points, const fm_claim_lost *row);
/* Why a row has no value: "K+B-Array k 8: crash". */
void claim_points_reason(char text[256], const fm_case_row *result, const char *why);
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
