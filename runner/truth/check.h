/* A method's fragments against truth, pixel by pixel. */
#ifndef FM_CHECK_H
#define FM_CHECK_H

#include "loss.h"
#include "scene/scene.h"

/* Sums over all pixels. */
typedef struct fm_check {
    uint32_t traits;    /* given: the method's, FM_TRAIT_* */
    uint64_t wanted;    /* fragments that the method was to hand over */
    fm_losses declared; /* of those, the ones that its traits say are lost */
    fm_losses excused;  /* of the missing ones, those that the traits excuse */
    uint64_t captured;  /* fragments handed over */
    uint64_t missing;   /* depths of the wanted multiset that were not captured */
    /* captured (depth, colour) pairs that the pixel does not have, or beyond the wanted count */
    uint64_t extra;
    uint64_t misordered;    /* neighbours in decreasing depth */
    uint64_t wrong_pixels;  /* pixels with any of these */
    uint32_t depth_ulp_max; /* most representable steps between the i-th captured depth and the
                               i-th wanted one */
} fm_check;

/* One pixel: `captured` in the order of ranks (reordered by this call), `truth` all of the pixel's
 * fragments, nearest first; wanted: how many of them, from the front, the method was to hand over.
 */
void check_pixel(fm_check *check, fm_fragment *captured, uint32_t captured_count,
                 const fm_fragment *truth, uint32_t truth_count, uint32_t wanted);

/* Missing fragments that are not declared, extra and misordered ones. */
uint64_t check_faults(const fm_check *check);

/* A depth as a number that rises with it, and how the check sorts: by depth, then by colour. */
uint32_t check_depth_bits(const fm_fragment *fragment);
int check_compare(const fm_fragment *a, const fm_fragment *b);

#endif
