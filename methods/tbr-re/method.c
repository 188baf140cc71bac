#include "fragmark/method.h"
#include "fragmark/technique.h"
#include "skip.h"

/* As the paper has it: a frame that uploads is neither compared nor, since it changes nothing of
 * that, is its signature less true. */
static bool skip(const fm_tile_start *tile)
{
    return !tile->has_uploads && re_skip(tile);
}

/* Every primitive is signed; a tile whose signature is that of the frame before keeps its colours.
 */
static const fm_technique technique = {
    .parts = FM_PART_SIGNATURES,
    .choices = { { "age", "2", FM_PART_TWO_BUFFERS }, { "uploads", "disable", FM_PART_UPLOADS } },
    .skip = skip,
};

const fm_method_desc fm_method = {
    .abi = FM_ABI,
    .size_bytes = sizeof(fm_method_desc),
    .id = "tbr-re",
    .title = "RE",
    .citation = "Anglada et al., Rendering Elimination: Early Discard of Redundant Tiles in the "
                "Graphics Pipeline, HPCA 2019",
    .version = "1",
    .traits = FM_TRAIT_EXACT,
    .feeds = FM_FEED_FRAMES,
    .keeps = FM_KEEPS_NEAREST,
    .family = FM_FAMILY_RASTERISER,
    .marker = FM_MARKER_SQUARE,
    .options = { { .name = "age",
                   .values = { "1", "2" },
                   .help = "frames since the one compared: 2 with two frame buffers in turns" },
                 { .name = "uploads",
                   .values = { "version", "disable" },
                   .help = "a texture's upload: signed by its version, or no tile is skipped" } },
    .technique = &technique,
};
