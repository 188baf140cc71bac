#include "orient.h"

#include <float.h>
#include <math.h>

/* Of two products of differences; Shewchuk's bound (1997, section 4.3) is 3/2 DBL_EPSILON. */
static const double rounding = 4 * DBL_EPSILON;

/* A sum that loses nothing: parts whose bits do not overlap, the smallest first. */
enum { PARTS_MAX = 12 };
typedef struct exact_sum {
    double parts[PARTS_MAX];
    int count;
} exact_sum;

/* Grow-Expansion (Shewchuk 1997, section 2.4): a sum of two and what it rounded off, part by part.
 */
static void add(exact_sum *sum, double x)
{
    for (int i = 0; i < sum->count; i++) {
        const double part = sum->parts[i], both = x + part, of_part = both - x;
        sum->parts[i] = (x - (both - of_part)) + (part - of_part);
        x = both;
    }
    sum->parts[sum->count++] = x;
}

static void add_product(exact_sum *sum, double a, double b)
{
    const double product = a * b;
    add(sum, fma(a, b, -product));
    add(sum, product);
}

/* The determinant, multiplied out: differences would round. */
static double orient_exactly(const double a[2], const double b[2], const double c[2])
{
    exact_sum sum = { .count = 0 };
    const double *const corners[] = { a, b, c };
    for (int i = 0; i < 3; i++) {
        const double *p = corners[i], *q = corners[(i + 1) % 3];
        add_product(&sum, p[0], q[1]);
        add_product(&sum, -p[1], q[0]);
    }
    for (int i = sum.count - 1; i >= 0; i--)
        if (fabs(sum.parts[i]) > 0.0)
            return sum.parts[i];
    return 0.0;
}

double orient(const double a[2], const double b[2], const double c[2])
{
    const double left = (b[0] - a[0]) * (c[1] - a[1]), right = (b[1] - a[1]) * (c[0] - a[0]);
    const double difference = left - right;
    return fabs(difference) > rounding * (fabs(left) + fabs(right)) ? difference
                                                                    : orient_exactly(a, b, c);
}
