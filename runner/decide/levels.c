#include "levels.h"

#include <math.h>
#include <stdlib.h>

/* A p-value, and which test's it is. */
typedef struct ranked {
    double p;
    size_t index;
} ranked;

static int compare_ranked(const void *left, const void *right)
{
    const double a = ((const ranked *)left)->p, b = ((const ranked *)right)->p;
    return (a > b) - (a < b);
}

fm_status levels_adjust(double *adjusted, const double *p, size_t count, fm_error *err)
{
    for (size_t i = 0; i < count; i++)
        if (!(p[i] >= 0.0 && p[i] <= 1.0))
            return fm_fail(err, FM_INVALID, "p-value %zu is %g: not from 0 to 1", i, p[i]);
    ranked *tests = calloc(count + 1, sizeof *tests);
    if (tests == NULL)
        return fm_fail(err, FM_NO_MEMORY, "no memory for %zu p-values", count);
    for (size_t i = 0; i < count; i++)
        tests[i] = (ranked){ p[i], i };
    qsort(tests, count, sizeof *tests, compare_ranked);
    double least = 1.0;
    for (size_t rank = count; rank > 0; rank--) {
        least = fmin(least, tests[rank - 1].p * (double)count / (double)rank);
        adjusted[tests[rank - 1].index] = least;
    }
    free(tests);
    return FM_OK;
}

fm_status levels_split(double *levels, const uint32_t *looks, size_t count, double level,
                       fm_error *err)
{
    if (count == 0 || !(level > 0.0 && level < 1.0))
        return fm_fail(err, FM_INVALID, "%zu looks at level %g: at least one, between 0 and 1",
                       count, level);
    for (size_t i = 0; i < count; i++)
        if (looks[i] <= (i > 0 ? looks[i - 1] : 0))
            return fm_fail(err, FM_INVALID, "look %zu, at %u: looks rise, from 1 on", i, looks[i]);
    for (size_t i = 0; i < count; i++)
        levels[i] = level * (double)(looks[i] - (i > 0 ? looks[i - 1] : 0)) / looks[count - 1];
    return FM_OK;
}
