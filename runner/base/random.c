#include "random.h"

#include <assert.h>

uint64_t random_next(uint64_t *state)
{
    uint64_t z = *state += 0x9E3779B97F4A7C15u;
    z = (z ^ z >> 30) * 0xBF58476D1CE4E5B9u;
    z = (z ^ z >> 27) * 0x94D049BB133111EBu;
    return z ^ z >> 31;
}

uint32_t random_below(uint64_t *state, uint32_t bound)
{
    assert(bound > 0);
    /* Lemire's multiplication; the lowest products are rejected, for they would favour some values.
     */
    const uint32_t reject_below = (0u - bound) % bound;
    for (;;) {
        const uint64_t product = (random_next(state) >> 32) * bound;
        if ((uint32_t)product >= reject_below)
            return (uint32_t)(product >> 32);
    }
}
