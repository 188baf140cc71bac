#include "fragmark/method.h"
#include "fragmark/technique.h"
#include "skip.h"

/* Every primitive is signed; a tile whose signature is that of the frame before keeps its colours.
 */
static const fm_technique technique = { .parts = FM_PART_SIGNATURES, .skip = re_skip };

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
    .technique = &technique,
};
