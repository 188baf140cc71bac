#include "fragmark/method.h"
#include "fragmark/technique.h"

/* A bound that nobody can build: that a tile did not change is known before it is rendered. */
static void tile_end(fm_tile_end *tile)
{
    tile->outcome = tile->is_equal ? FM_TILE_FORESEEN : FM_TILE_FLUSHED;
}

static const fm_technique technique = { .parts = FM_PART_PREVIOUS_COLOUR, .tile_end = tile_end };

const fm_method_desc fm_method = {
    .abi = FM_ABI,
    .size_bytes = sizeof(fm_method_desc),
    .id = "tbr-oracle-tile",
    .title = "Oracle tile",
    .citation = "oracle of the paper on EVR (VII): every tile that equals that of the last frame "
                "is skipped",
    .version = "1",
    .traits = FM_TRAIT_EXACT,
    .feeds = FM_FEED_FRAMES,
    .keeps = FM_KEEPS_NEAREST,
    .family = FM_FAMILY_RASTERISER,
    .marker = FM_MARKER_CIRCLE,
    .dashed = true,
    .technique = &technique,
};
