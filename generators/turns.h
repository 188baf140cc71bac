/* Sine and cosine that are the same bits on every machine: the C library's are not. */
#ifndef FM_TURNS_H
#define FM_TURNS_H

/* Of an angle in turns (1 is a full circle), at most 2^50 of them; within 1e-15. */
double turn_sin(double turns);
double turn_cos(double turns);

#endif
