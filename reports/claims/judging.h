/* What decides a claim of several points: the worst of them; for form `any` the best. */
#ifndef FM_CLAIM_JUDGING_H
#define FM_CLAIM_JUDGING_H

#include "points.h"
#include "verdict.h"

/* Of one point, or of two. */
typedef struct decision {
    fm_verdict_kind kind;
    fm_interval measured;        /* what was compared with the claim */
    double margin;               /* of two of a kind, the smaller one is worse */
    const fm_claim_point *a, *b; /* between which points; b may be NULL */
} decision;

/* A claim being judged. Starts with the first three, which are borrowed, then judging_begin. */
typedef struct judging {
    const fm_claim *claim;
    const fm_claim_rows *rows;
    const fm_claim_points *points;
    decision worst;
    double least, greatest; /* medians of all decisions */
    size_t count;           /* of decisions */
    size_t skipped;         /* points that gave no decision, but for incomplete ones */
    char note[160];         /* the first reason why something was not judged */
} judging;

void judging_begin(judging *to);
/* Takes a decision; the worst so far is kept. */
void judging_decide(judging *to, const decision *made);
/* Decides by where the value lies between the claim's bounds. */
void judging_value(judging *to, fm_interval value, const fm_claim_point *a,
                   const fm_claim_point *b);
/* Decides whether `next` lies above `point` by `least`. */
void judging_rise(judging *to, const fm_claim_point *point, const fm_claim_point *next,
                  double least);
/* Decides whether `next` lies below `point` by the tolerance at most. */
void judging_step(judging *to, const fm_claim_point *point, const fm_claim_point *next);
/* Adds a remark to the reason, as printf does; the first one is kept. */
void judging_note(judging *to, const char *format, ...) __attribute__((format(printf, 2, 3)));
/* points[count] cannot be judged, and why. */
void judging_skip(judging *to, const fm_claim_point *points, size_t count, const char *format, ...)
    __attribute__((format(printf, 4, 5)));
/* The verdict, and its reason in words. */
void judging_end(fm_verdict *verdict, const judging *to);

#endif
