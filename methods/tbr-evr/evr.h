/* Early Visibility Resolution: prediction (III-C), reordering (Algorithm 1), the farthest visible
 * point (V-C), shared by the techniques that have a part of it. */
#ifndef TBR_EVR_EVR_H
#define TBR_EVR_EVR_H

#include "fragmark/technique.h"

/* Hidden if a farther layer than the farthest visible one of the last frame, or, both writing
 * depth, if its nearest vertex lies behind the farthest visible depth. */
static inline fm_prediction evr_predict(const fm_pair *pair)
{
    if (pair->fvp.is_layer)
        return pair->layer < pair->fvp.value ? FM_HIDDEN_BY_LAYER : FM_VISIBLE;
    if (pair->type == FM_TYPE_WOZ && pair->depth_near > pair->fvp.value)
        return FM_HIDDEN_BY_DEPTH;
    return FM_VISIBLE;
}

/* Algorithm 1. */
static inline fm_place evr_place(const fm_pair *pair, fm_prediction prediction)
{
    if (pair->type != FM_TYPE_WOZ)
        return FM_PLACE_BARRIER;
    return prediction == FM_VISIBLE ? FM_PLACE_FIRST : FM_PLACE_SECOND;
}

/* The point is a depth if the last layer of depth writers that passed is the farthest visible one,
 * or, with a bit for each pixel, if a depth writer is visible in that layer. */
static inline void evr_tile_end(fm_tile_end *tile)
{
    const bool is_depth =
        (tile->parts & FM_PART_OWNER) != 0 ? tile->far_is_woz : tile->zr == tile->layer_far;
    if (is_depth)
        tile->fvp = (fm_fvp){ .is_layer = false, .value = tile->depth_far };
    else
        tile->fvp = (fm_fvp){ .is_layer = true, .value = tile->layer_far };
}

#endif
