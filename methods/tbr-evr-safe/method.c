#include "fragmark/method.h"
#include "../tbr-evr/evr.h"
#include "../tbr-re/skip.h"
#include "fragmark/technique.h"

/* Bits of a tile in a frame. */
enum {
    LEFT_OUT = 1u, /* a depth writer was left out because of its layer */
    UNUSABLE = 2u, /* and then a signed, depth-tested primitive came: it may fare otherwise */
};

static bool sign(uint32_t *bits, const fm_pair *pair, fm_prediction prediction)
{
    if (prediction == FM_VISIBLE) {
        if ((*bits & LEFT_OUT) != 0 && pair->depth_test)
            *bits |= UNUSABLE;
        return true;
    }
    if (prediction == FM_HIDDEN_BY_LAYER && pair->type != FM_TYPE_NWOZ)
        *bits |= LEFT_OUT;
    return false;
}

static bool skip(const fm_tile_start *tile)
{
    return (tile->bits & UNUSABLE) == 0 && re_skip(tile);
}

static void tile_end(fm_tile_end *tile)
{
    evr_tile_end(tile);
    if (tile->depth_cleared && !tile->fvp.is_layer)
        tile->fvp = FM_FVP_UNKNOWN; /* what lay before the clear was tested against other depths */
    tile->signature_valid = (tile->bits & UNUSABLE) == 0 && !tile->unsafe;
}

static const fm_technique technique = {
    .parts = FM_PART_VISIBILITY | FM_PART_SIGNATURES | FM_PART_TAINT,
    .choices = { { "tie", "exact", FM_PART_EXACT_TIES },
                 { "types", "paper", FM_PART_PAPER_TYPES },
                 { "age", "2", FM_PART_TWO_BUFFERS } },
    .predict = evr_predict,
    .place = evr_place,
    .sign = sign,
    .skip = skip,
    .tile_end = tile_end,
};

const fm_method_desc fm_method = {
    .abi = FM_ABI,
    .size_bytes = sizeof(fm_method_desc),
    .id = "tbr-evr-safe",
    .title = "EVR safe",
    .citation = "EVR (Anglada et al., HPCA 2019) with signatures that are dropped where they do "
                "not tell all",
    .version = "1",
    .traits = FM_TRAIT_EXACT,
    .feeds = FM_FEED_FRAMES,
    .keeps = FM_KEEPS_NEAREST,
    .family = FM_FAMILY_RASTERISER,
    .marker = FM_MARKER_PLUS,
    .options = { { .name = "tie",
                   .values = { "exact", "paper" },
                   .help = "equal depths across the lists: as submitted, or as they come" },
                 { .name = "types",
                   .values = { "exact", "paper" },
                   .help = "paper: whatever writes depth may be reordered" },
                 { .name = "age",
                   .values = { "1", "2" },
                   .help = "frames since the one compared: 2 with two frame buffers in turns" } },
    .technique = &technique,
};
