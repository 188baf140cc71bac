#include "fragmark/method.h"
#include "fragmark/technique.h"

static void tile_end(fm_tile_end *tile)
{
    tile->outcome = tile->is_equal ? FM_TILE_KEPT : FM_TILE_FLUSHED;
}

/* Colours themselves are compared where the hardware compares their CRC: no collisions. */
static const fm_technique technique = { .parts = FM_PART_PREVIOUS_COLOUR, .tile_end = tile_end };

const fm_method_desc fm_method = {
    .abi = FM_ABI,
    .size_bytes = sizeof(fm_method_desc),
    .id = "tbr-te",
    .title = "Transaction elimination",
    .citation = "ARM, Transaction Elimination (Mali GPUs): what did not change is rendered, but "
                "not written",
    .version = "1",
    .traits = FM_TRAIT_EXACT,
    .feeds = FM_FEED_FRAMES,
    .keeps = FM_KEEPS_NEAREST,
    .family = FM_FAMILY_RASTERISER,
    .marker = FM_MARKER_SQUARE,
    .dashed = true,
    .technique = &technique,
};
