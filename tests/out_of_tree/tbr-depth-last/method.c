#include "fragmark/method.h"
#include "fragmark/technique.h"

/* A technique of the simulated GPU: what lies behind the farthest depth that a tile had when it was
 * last rendered is drawn last, so that the early depth test rejects it. */
static fm_prediction predict(const fm_pair *pair)
{
    const bool is_behind = pair->type == FM_TYPE_WOZ && pair->depth_near > pair->fvp.value;
    return is_behind ? FM_HIDDEN_BY_DEPTH : FM_VISIBLE;
}

static fm_place place(const fm_pair *pair, fm_prediction prediction)
{
    if (pair->type != FM_TYPE_WOZ)
        return FM_PLACE_BARRIER;
    return prediction == FM_VISIBLE ? FM_PLACE_FIRST : FM_PLACE_SECOND;
}

static void tile_end(fm_tile_end *tile)
{
    tile->fvp = (fm_fvp){ .is_layer = false, .value = tile->depth_far };
}

static const fm_technique technique = {
    .parts = FM_PART_VISIBILITY | FM_PART_EXACT_TIES,
    .predict = predict,
    .place = place,
    .tile_end = tile_end,
};

const fm_method_desc fm_method = {
    .abi = FM_ABI,
    .size_bytes = sizeof(fm_method_desc),
    .id = "tbr-depth-last",
    .title = "Depth last",
    .citation = "an example: half of the reordering of Anglada et al., HPCA 2019, IV-A",
    .version = "1",
    .traits = FM_TRAIT_EXACT,
    .feeds = FM_FEED_FRAMES,
    .keeps = FM_KEEPS_NEAREST,
    .technique = &technique,
};
