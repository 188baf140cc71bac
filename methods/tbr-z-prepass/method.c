#include "fragmark/method.h"
#include "fragmark/technique.h"

/* All primitives that may be reordered are drawn twice, first their depth alone. */
static const fm_technique technique = { .parts = FM_PART_PREPASS };

const fm_method_desc fm_method = {
    .abi = FM_ABI,
    .size_bytes = sizeof(fm_method_desc),
    .id = "tbr-z-prepass",
    .title = "Z-prepass",
    .citation = "depth-only pass first, as in early-Z rejection samples",
    .version = "1",
    .traits = FM_TRAIT_EXACT,
    .feeds = FM_FEED_FRAMES,
    .keeps = FM_KEEPS_NEAREST,
    .family = FM_FAMILY_RASTERISER,
    .marker = FM_MARKER_PLUS,
    .dashed = true,
    .technique = &technique,
};
