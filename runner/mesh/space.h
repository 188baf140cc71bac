/* Where a mesh lies: boxes, and the space in which its coordinates are floats. */
#ifndef FM_SPACE_H
#define FM_SPACE_H

typedef struct fm_box {
    double low[3], high[3];
} fm_box;

/* From the file's units to the mesh's own: scaled by 2^-exponent, then moved by -origin. Both are
 * of doubles; the scale is exact. {0}: the units stay. */
typedef struct fm_space {
    int exponent;
    double origin[3]; /* whole numbers, in scaled units */
} fm_space;

/* The space in which the box's largest side is between 1/2 and 1 and no coordinate is above 1. A
 * box that lies about the origin is scaled only: each step of the origin is a multiple of a power
 * of two that is no smaller than the box, so that what a float held before, it mostly holds after.
 * box: finite. */
fm_space space_of(const fm_box *box);
void space_point(double moved[3], const fm_space *space, const double point[3]);
/* A length in the file's units. */
double space_length(const fm_space *space, double length);
/* Infinite where a double cannot hold it. */
fm_box space_box(const fm_space *space, const fm_box *box);

#endif
