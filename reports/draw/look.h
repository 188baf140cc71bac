/* How families and methods look, the same in every chart. */
#ifndef FM_LOOK_H
#define FM_LOOK_H

#include <stdint.h>

#include "fragmark/method.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct fm_colour {
    uint8_t r, g, b;
} fm_colour;

/* Okabe and Ito's eight colours, told apart by colour-blind readers: one a family. */
fm_colour look_family_colour(fm_family family);
/* The colour of a method's i-th variant (other options): the first is the colour itself, the next
 * ones darker; from the sixth on they are alike. */
fm_colour look_shade(fm_colour colour, size_t variant);
/* Of what another one beats in speed and error. */
fm_colour look_dominated_colour(void);
/* A colour for the i-th part of a stacked bar: clear, count, reference, store, resolve, other. */
fm_colour look_part_colour(size_t part);
enum { FM_LOOK_PARTS = 8 };

#ifdef __cplusplus
}
#endif

#endif
