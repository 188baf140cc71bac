#include "space.h"

#include <math.h>

/* Half of each side: a whole side may be beyond a double. */
static double half_side(const fm_box *box, int axis)
{
    return 0.5 * box->high[axis] - 0.5 * box->low[axis];
}

fm_space space_of(const fm_box *box)
{
    fm_space space = { 0 };
    const double half = fmax(half_side(box, 0), fmax(half_side(box, 1), half_side(box, 2)));
    if (!(half > 0.0))
        return space;
    frexp(half, &space.exponent);
    space.exponent++; /* of the whole side */
    for (int axis = 0; axis < 3; axis++)
        space.origin[axis] =
            rint(space_length(&space, 0.5 * box->low[axis] + 0.5 * box->high[axis]));
    return space;
}

double space_length(const fm_space *space, double length)
{
    return ldexp(length, -space->exponent);
}

void space_point(double moved[3], const fm_space *space, const double point[3])
{
    for (int axis = 0; axis < 3; axis++)
        moved[axis] = space_length(space, point[axis]) - space->origin[axis];
}

fm_box space_box(const fm_space *space, const fm_box *box)
{
    fm_box moved;
    space_point(moved.low, space, box->low);
    space_point(moved.high, space, box->high);
    return moved;
}
