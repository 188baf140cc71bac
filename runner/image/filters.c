#include "filters.h"

#include <string.h>

/* So many sums stay in registers while the taps go by. */
enum { CHUNK = 16, CHUNK_DOUBLE = 8 };

/* `lanes` pixels from i on. Inlined with a constant kind and number. */
static inline __attribute__((always_inline)) void filter_lanes(float *to, const float *const *rows,
                                                               const filter_kernel *kernel,
                                                               size_t i, int lanes,
                                                               filter_kind kind)
{
    float middle[CHUNK], sum[CHUNK] = { 0 };
    memcpy(middle, rows[kernel->radius] + i, (size_t)lanes * sizeof *middle);
    for (int t = 1; t <= kernel->radius; t++) {
        const float *after = rows[kernel->radius + t] + i, *before = rows[kernel->radius - t] + i;
        const float weight = kernel->weights[t];
        for (int lane = 0; lane < lanes; lane++)
            sum[lane] += weight * (kind == FILTER_FIRST ? after[lane] - before[lane]
                                                        : (after[lane] - middle[lane]) +
                                                              (before[lane] - middle[lane]));
    }
    for (int lane = 0; lane < lanes; lane++)
        to[i + (size_t)lane] = kind == FILTER_SMOOTH ? middle[lane] + sum[lane] : sum[lane];
}

static inline __attribute__((always_inline)) void filter_all(float *to, const float *const *rows,
                                                             const filter_kernel *kernel,
                                                             size_t count, filter_kind kind)
{
    size_t i = 0;
    for (; i + CHUNK <= count; i += CHUNK)
        filter_lanes(to, rows, kernel, i, CHUNK, kind);
    for (; i < count; i++)
        filter_lanes(to, rows, kernel, i, 1, kind);
}

void filter_rows(float *to, const float *const *rows, const filter_kernel *kernel, size_t count)
{
    switch (kernel->kind) {
    case FILTER_SMOOTH:
        filter_all(to, rows, kernel, count, FILTER_SMOOTH);
        break;
    case FILTER_FIRST:
        filter_all(to, rows, kernel, count, FILTER_FIRST);
        break;
    case FILTER_SECOND:
        filter_all(to, rows, kernel, count, FILTER_SECOND);
        break;
    }
}

void filter_rows_double(double *to, const double *const *rows, const double *weights, int taps,
                        size_t count)
{
    size_t i = 0;
    for (; i + CHUNK_DOUBLE <= count; i += CHUNK_DOUBLE) {
        double sum[CHUNK_DOUBLE] = { 0 };
        for (int t = 0; t < taps; t++)
            for (int lane = 0; lane < CHUNK_DOUBLE; lane++)
                sum[lane] += weights[t] * rows[t][i + (size_t)lane];
        memcpy(to + i, sum, sizeof sum);
    }
    for (; i < count; i++) {
        double sum = 0;
        for (int t = 0; t < taps; t++)
            sum += weights[t] * rows[t][i];
        to[i] = sum;
    }
}
