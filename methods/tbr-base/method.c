#include "fragmark/method.h"
#include "fragmark/technique.h"

/* The GPU as it is: no hook, no part. */
static const fm_technique technique = { 0 };

const fm_method_desc fm_method = {
    .abi = FM_ABI,
    .size_bytes = sizeof(fm_method_desc),
    .id = "tbr-base",
    .title = "Baseline",
    .citation = "ARM Mali-450 as in the paper on EVR: tiles in submission order, early depth test",
    .version = "1",
    .traits = FM_TRAIT_EXACT,
    .feeds = FM_FEED_FRAMES,
    .keeps = FM_KEEPS_NEAREST,
    .family = FM_FAMILY_RASTERISER,
    .marker = FM_MARKER_CROSS,
    .technique = &technique,
};
