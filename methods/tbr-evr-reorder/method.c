#include "fragmark/method.h"
#include "../tbr-evr/evr.h"
#include "fragmark/technique.h"

/* Only the first of the paper's two uses: what is predicted hidden is drawn last. */
static const fm_technique technique = {
    .parts = FM_PART_VISIBILITY,
    .choices = { { "tie", "exact", FM_PART_EXACT_TIES },
                 { "types", "paper", FM_PART_PAPER_TYPES },
                 { "fvp", "owner", FM_PART_OWNER } },
    .predict = evr_predict,
    .place = evr_place,
    .tile_end = evr_tile_end,
};

const fm_method_desc fm_method = {
    .abi = FM_ABI,
    .size_bytes = sizeof(fm_method_desc),
    .id = "tbr-evr-reorder",
    .title = "EVR reorder",
    .citation = "Anglada et al., Early Visibility Resolution for Removing Ineffectual Computations "
                "in the Graphics Pipeline, HPCA 2019, IV-A",
    .version = "1",
    .traits = FM_TRAIT_EXACT,
    .feeds = FM_FEED_FRAMES,
    .keeps = FM_KEEPS_NEAREST,
    .family = FM_FAMILY_RASTERISER,
    .marker = FM_MARKER_DIAMOND,
    .options = { { .name = "tie",
                   .values = { "exact", "paper" },
                   .help = "equal depths across the lists: as submitted, or as they come" },
                 { .name = "types",
                   .values = { "exact", "paper" },
                   .help = "paper: whatever writes depth may be reordered" },
                 { .name = "fvp",
                   .values = { "zr", "owner" },
                   .help = "type of the farthest point: by register ZR, or by a bit a pixel" } },
    .technique = &technique,
};
