/* On which side of a line a point lies, exactly. */
#ifndef FM_ORIENT_H
#define FM_ORIENT_H

/* Above 0: c lies to the left of the line from a to b; below 0: to the right; 0: on it. The sign is
 * exact, the size is not. Coordinates are 0, or 2^-400 to 2^400 in size: then no product leaves the
 * range of a double. */
double orient(const double a[2], const double b[2], const double c[2]);

#endif
