/* The cheapest method for an error that one can bear. */
#ifndef FM_CHEAPEST_H
#define FM_CHEAPEST_H

#include "standing.h"

enum { CHEAPEST_BOUNDS = 5 };
/* Errors up to these: 0 stands for exact, up to rounding. */
extern const double cheapest_bounds[CHEAPEST_BOUNDS];

typedef struct fm_cheapest {
    const fm_case_row *row; /* NULL: no case has so little error */
    fm_span ratio;          /* its time over that of the cheapest exact one; NAN: none is exact */
    size_t tied_count;      /* others within the bound whose times overlap with its own */
} fm_cheapest;

/* cheapest: [CHEAPEST_BOUNDS]; by median frame_ms, of the cases that compete. There is none where
 * cases differ in n: the cheapest would be the one that has the least to do. false: no memory. */
bool cheapest_make(fm_cheapest *cheapest, const fm_group *group, const fm_error_kind *kind);

#endif
