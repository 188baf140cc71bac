/* Where depths tie, truth allows every order of the tied fragments. For each channel of a pixel the
 * values that these orders composite to have a smallest and a largest one: an interval.
 *
 * Exchanging two neighbours of a tied group, i before j, changes a channel by c_i a_j - c_j a_i (c
 * premultiplied, a the alpha). So the largest value comes from the order of falling c / a, the
 * smallest from the order of rising c / a; a = 0 < c is infinite, and c = a = 0 changes nothing.
 * The group lets the same share through in every order, so its neighbours do not matter.
 *
 * If only m of a group's fragments are wanted, because it straddles the k-th place, each subset of
 * m is allowed. With f(i, j) the best that j of the sorted fragments from i on composite to,
 *     f(i, j) = best of f(i + 1, j) and c_i + (1 - a_i) f(i + 1, j - 1).
 * If all have one alpha, the places have fixed weights, and the m with the largest (smallest) c in
 * that order are the best. */
#ifndef FM_TIES_H
#define FM_TIES_H

#include "scene/scene.h"

/* The values that a pixel's channels may have, each for itself. */
typedef struct fm_range {
    double low[4], high[4];
} fm_range;

/* Memory for pixels of up to n fragments. */
typedef struct fm_ties fm_ties;
fm_status ties_create(fm_ties **ties, uint32_t n, fm_error *err);
void ties_destroy(fm_ties *ties);

/* Whether fragments of equal depth and different colour are among the first `wanted`, or straddle
 * their end: which comes first, or at all, is open. fragments: nearest first. */
bool ties_are_open(const fm_fragment *fragments, uint32_t count, uint32_t wanted);

/* What the `wanted` nearest of these fragments, nearest first, may composite to. */
void ties_range(fm_range *range, fm_ties *ties, const fm_fragment *fragments, uint32_t count,
                uint32_t wanted);

#endif
