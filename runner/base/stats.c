#include "stats.h"

#include <assert.h>
#include <math.h>
#include <stdbool.h>
#include <stdlib.h>

#include "random.h"

enum { REPLICATES = 1000, LOW_INDEX = 24, HIGH_INDEX = 975 }; /* 2.5 % and 97.5 % */

/* NAN sorts last, so that the order is total and qsort stays defined. */
static int compare_doubles(const void *left, const void *right)
{
    const double a = *(const double *)left, b = *(const double *)right;
    if (isnan(a) || isnan(b))
        return (int)(isnan(a) != 0) - (int)(isnan(b) != 0);
    return (a > b) - (a < b);
}

double stats_median(double *values, size_t count)
{
    if (count == 0)
        return NAN;
    qsort(values, count, sizeof *values, compare_doubles);
    const size_t middle = count / 2;
    return count % 2 == 1 ? values[middle] : 0.5 * (values[middle - 1] + values[middle]);
}

/* The samples by group; groups without a sample are left out. */
typedef struct grouped {
    double *values;  /* [count] */
    size_t *offsets; /* [group_count + 1] */
    double *drawn;   /* room for the largest replicate */
    uint32_t group_count;
} grouped;

static void grouped_free(grouped *g)
{
    free(g->values);
    free(g->offsets);
    free(g->drawn);
}

/* A stable counting sort; false without memory. */
static bool grouped_build(grouped *g, const fm_samples *samples)
{
    size_t largest = 0, written = 0;
    *g = (grouped){ .values = calloc(samples->count, sizeof(double)),
                    .offsets = calloc((size_t)samples->group_count + 1, sizeof(size_t)) };
    size_t *sizes = calloc(samples->group_count, sizeof *sizes);
    size_t *starts = calloc(samples->group_count, sizeof *starts);
    const bool has_room =
        g->values != NULL && g->offsets != NULL && sizes != NULL && starts != NULL;
    for (size_t i = 0; has_room && i < samples->count; i++) {
        assert(samples->group_of[i] < samples->group_count);
        sizes[samples->group_of[i]]++;
    }
    for (uint32_t group = 0; has_room && group < samples->group_count; group++) {
        starts[group] = written;
        written += sizes[group];
        if (sizes[group] > 0)
            g->offsets[++g->group_count] = written;
        largest = sizes[group] > largest ? sizes[group] : largest;
    }
    for (size_t i = 0; has_room && i < samples->count; i++)
        g->values[starts[samples->group_of[i]]++] = samples->values[i];
    free(starts);
    free(sizes);
    const size_t replicate_max = largest * g->group_count;
    if (has_room && replicate_max > 0)
        g->drawn = calloc(replicate_max, sizeof(double));
    return g->drawn != NULL;
}

static double replicate(grouped *g, uint64_t *state)
{
    size_t drawn = 0;
    for (uint32_t i = 0; i < g->group_count; i++) {
        const uint32_t group = random_below(state, g->group_count);
        const size_t start = g->offsets[group], size = g->offsets[group + 1] - start;
        for (size_t j = 0; j < size; j++)
            g->drawn[drawn++] = g->values[start + random_below(state, (uint32_t)size)];
    }
    return stats_median(g->drawn, drawn);
}

fm_interval stats_bootstrap(const fm_samples *samples, uint64_t seed)
{
    fm_interval result = { NAN, NAN, NAN };
    grouped g = { 0 };
    double *medians = NULL;
    if (samples->count == 0)
        return result;
    assert(samples->count <= UINT32_MAX && samples->group_count > 0);
    medians = calloc(REPLICATES, sizeof *medians);
    if (medians == NULL || !grouped_build(&g, samples))
        goto out;
    for (size_t i = 0; i < REPLICATES; i++)
        medians[i] = replicate(&g, &seed);
    qsort(medians, REPLICATES, sizeof *medians, compare_doubles);
    result.low = medians[LOW_INDEX];
    result.high = medians[HIGH_INDEX];
    result.median = stats_median(g.values, samples->count);
out:
    grouped_free(&g);
    free(medians);
    return result;
}

double stats_student(size_t degrees)
{
    static const double table[] = { INFINITY, 12.706, 4.303, 3.182, 2.776, 2.571, 2.447,
                                    2.365,    2.306,  2.262, 2.228, 2.201, 2.179, 2.160,
                                    2.145,    2.131,  2.120, 2.110, 2.101, 2.093, 2.086 };
    enum { LAST = sizeof table / sizeof table[0] - 1 };
    return degrees <= LAST ? table[degrees] : table[LAST]; /* more than needed: at most 6 % */
}
