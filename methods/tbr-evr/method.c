#include "fragmark/method.h"
#include "../tbr-re/skip.h"
#include "evr.h"
#include "fragmark/technique.h"

/* What is predicted hidden is not signed, as published: it may be visible all the same, and then
 * the signature does not tell when it goes (README.md). */
static bool sign(uint32_t *bits, const fm_pair *pair, fm_prediction prediction)
{
    (void)bits, (void)pair;
    return prediction == FM_VISIBLE;
}

static const fm_technique technique = {
    .parts = FM_PART_VISIBILITY | FM_PART_SIGNATURES,
    .choices = { { "tie", "exact", FM_PART_EXACT_TIES },
                 { "types", "paper", FM_PART_PAPER_TYPES },
                 { "age", "2", FM_PART_TWO_BUFFERS },
                 { "fvp", "owner", FM_PART_OWNER } },
    .predict = evr_predict,
    .place = evr_place,
    .sign = sign,
    .skip = re_skip,
    .tile_end = evr_tile_end,
};

const fm_method_desc fm_method = {
    .abi = FM_ABI,
    .size_bytes = sizeof(fm_method_desc),
    .id = "tbr-evr",
    .title = "EVR",
    .citation = "Anglada et al., Early Visibility Resolution for Removing Ineffectual Computations "
                "in the Graphics Pipeline, HPCA 2019",
    .version = "1",
    .traits = 0,
    .feeds = FM_FEED_FRAMES,
    .keeps = FM_KEEPS_NEAREST,
    .family = FM_FAMILY_RASTERISER,
    .marker = FM_MARKER_CIRCLE,
    .options = { { .name = "tie",
                   .values = { "paper", "exact" },
                   .help = "equal depths across the lists: as submitted, or as they come" },
                 { .name = "types",
                   .values = { "exact", "paper" },
                   .help = "paper: whatever writes depth may be reordered" },
                 { .name = "fvp",
                   .values = { "zr", "owner" },
                   .help = "type of the farthest point: by register ZR, or by a bit a pixel" },
                 { .name = "age",
                   .values = { "1", "2" },
                   .help = "frames since the one compared: 2 with two frame buffers in turns" } },
    .technique = &technique,
};
