#include "fragmark/method.h"
#include "fragmark/technique.h"

/* Objects are drawn front to back, by what the last frame knew of them; the image must not tell. */
static const fm_technique technique = { .parts = FM_PART_OBJECT_ORDER | FM_PART_EXACT_TIES };

const fm_method_desc fm_method = {
    .abi = FM_ABI,
    .size_bytes = sizeof(fm_method_desc),
    .id = "tbr-vro-lite",
    .title = "VRO lite",
    .citation = "after de Lucas et al., Visibility Rendering Order, IEEE TPDS 2019: objects front "
                "to back, from the last frame",
    .version = "1",
    .traits = FM_TRAIT_EXACT,
    .feeds = FM_FEED_FRAMES,
    .keeps = FM_KEEPS_NEAREST,
    .family = FM_FAMILY_RASTERISER,
    .marker = FM_MARKER_DIAMOND,
    .dashed = true,
    .technique = &technique,
};
