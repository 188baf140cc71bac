/* Fragments that a method lost and had declared to lose: which of the missing ones its traits
 * excuse. */
#ifndef FM_LOSS_H
#define FM_LOSS_H

#include "fragmark/method.h"
#include "scene/scene.h"

/* Sums over all pixels. A missing fragment counts once at most. */
typedef struct fm_losses {
    uint64_t at_depth_one; /* FM_TRAIT_LOSES_DEPTH_ONE: depth exactly 1.0 */
    uint64_t
        of_ties; /* FM_TRAIT_LOSES_TIES, _PASSES_LOSE_TIES: all but one of those at one depth */
} fm_losses;

/* One pixel: `captured` ascending by depth; `truth` ascending by depth, the `wanted` fragments that
 * the method was to hand over. traits: FM_TRAIT_*, of which the two above matter. */
void loss_count(fm_losses *losses, uint32_t traits, const fm_fragment *captured,
                uint32_t captured_count, const fm_fragment *truth, uint32_t wanted);

/* Whether a pixel's wanted fragments, nearest first, are such that the traits excuse a loss. */
bool loss_may_touch(uint32_t traits, const fm_fragment *truth, uint32_t wanted);

#endif
