/* Ranks of values, doubled, so that they are whole also where equal values share the mean of
 * theirs.
 */
#ifndef FM_DECIDE_RANKS_H
#define FM_DECIDE_RANKS_H

#include <stddef.h>
#include <stdint.h>

/* Twice the rank, from 1 on, of a value among `sorted`, which has it. */
uint32_t doubled_rank(const double *sorted, size_t count, double value);

#endif
