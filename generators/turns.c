#include "turns.h"

#include <math.h>

static const double radians_in_turn = 6.28318530717958647692;

/* Taylor, for |x| <= pi/4: the next terms are below 2^-57. */
static double sine(double x)
{
    const double s = x * x;
    return x *
           (1 -
            s / 6 *
                (1 -
                 s / 20 *
                     (1 - s / 42 * (1 - s / 72 * (1 - s / 110 * (1 - s / 156 * (1 - s / 210)))))));
}

static double cosine(double x)
{
    const double s = x * x;
    return 1 -
           s / 2 *
               (1 -
                s / 12 *
                    (1 -
                     s / 30 *
                         (1 -
                          s / 56 * (1 - s / 90 * (1 - s / 132 * (1 - s / 182 * (1 - s / 240)))))));
}

/* The quarter is exact; what is left of it is below an eighth of a turn. */
double turn_sin(double turns)
{
    const double quarter = rint(4 * turns);
    const double x = (turns - quarter / 4) * radians_in_turn;
    switch ((unsigned)((long long)quarter & 3)) {
    case 0:
        return sine(x);
    case 1:
        return cosine(x);
    case 2:
        return -sine(x);
    default:
        return -cosine(x);
    }
}

double turn_cos(double turns)
{
    return turn_sin(turns + 0.25);
}
