/* Random numbers for tests: the same from the same state, on every machine. */
#ifndef FM_TESTS_RANDOM_KIT_H
#define FM_TESTS_RANDOM_KIT_H

#include <stdint.h>

/* splitmix64 */
static inline uint64_t draw_u64(uint64_t *state)
{
    uint64_t z = *state += 0x9E3779B97F4A7C15u;
    z = (z ^ z >> 30) * 0xBF58476D1CE4E5B9u;
    z = (z ^ z >> 27) * 0x94D049BB133111EBu;
    return z ^ z >> 31;
}

/* low..high */
static inline uint32_t draw_in(uint64_t *state, uint32_t low, uint32_t high)
{
    return low + (uint32_t)(draw_u64(state) % (high - low + 1));
}

/* low..high, both at most a part of 2^24 missed */
static inline float draw_real(uint64_t *state, float low, float high)
{
    return low + (high - low) * (float)(draw_u64(state) >> 40) * 0x1p-24f;
}

#endif
