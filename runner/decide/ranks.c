#include "ranks.h"

uint32_t doubled_rank(const double *sorted, size_t count, double value)
{
    size_t below = 0, equal = 0;
    while (below < count && sorted[below] < value)
        below++;
    while (below + equal < count && sorted[below + equal] == value)
        equal++;
    return (uint32_t)(2 * below + equal + 1);
}
