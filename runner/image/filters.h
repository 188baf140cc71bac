/* Separable filters over rows of pixels. A filter takes rows, or one row at several offsets: both
 * are pointers to where its taps begin, so that one loop serves both directions. */
#ifndef FM_FILTERS_H
#define FM_FILTERS_H

#include <stddef.h>

enum { FILTER_RADIUS_MOST = 136 };

/* What a filter of mirrored weights does: to each pixel the sum over t = 1 ... radius of
 * weights[t] * ((after_t - middle) + (before_t - middle)) is added (smooth), is taken for it
 * (second derivative), or is taken with the difference of the two (first derivative). Weighted so,
 * a picture of one colour stays as it is, and has derivatives of 0, without a rounding error. */
typedef enum filter_kind { FILTER_SMOOTH, FILTER_FIRST, FILTER_SECOND } filter_kind;

typedef struct filter_kernel {
    filter_kind kind;
    int radius;
    float weights[FILTER_RADIUS_MOST + 1]; /* the first is not read */
} filter_kernel;

/* rows: [2 radius + 1], the middle one at [radius]; each has count pixels. */
void filter_rows(float *to, const float *const *rows, const filter_kernel *kernel, size_t count);

/* to[i] = sum over t < taps of weights[t] * rows[t][i], in double precision. */
void filter_rows_double(double *to, const double *const *rows, const double *weights, int taps,
                        size_t count);

#endif
