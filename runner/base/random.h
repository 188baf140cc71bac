/* The only source of randomness: a generator whose whole state the caller holds, so that everything
 * random follows from a seed. */
#ifndef FM_RANDOM_H
#define FM_RANDOM_H

#include <stdint.h>

/* The next value of splitmix64 (Steele, Lea, Flood 2014, doi:10.1145/2660193.2660195). *state is
 * the seed at first; any value will do. */
uint64_t random_next(uint64_t *state);
/* Uniform in [0, bound). bound > 0. */
uint32_t random_below(uint64_t *state, uint32_t bound);

#endif
