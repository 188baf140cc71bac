#include "fragmark/method.h"
#include "fragmark/technique.h"

/* A bound that nobody can build. */
static const fm_technique technique = { .parts = FM_PART_FINAL_DEPTH };

const fm_method_desc fm_method = {
    .abi = FM_ABI,
    .size_bytes = sizeof(fm_method_desc),
    .id = "tbr-oracle-z",
    .title = "Oracle Z",
    .citation = "oracle of the paper on EVR (VII): the depth buffer starts as it will end",
    .version = "1",
    .traits = FM_TRAIT_EXACT,
    .feeds = FM_FEED_FRAMES,
    .keeps = FM_KEEPS_NEAREST,
    .family = FM_FAMILY_RASTERISER,
    .marker = FM_MARKER_CROSS,
    .dashed = true,
    .technique = &technique,
};
