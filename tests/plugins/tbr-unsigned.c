/* Rendering elimination that signs nothing: from the second frame on every tile keeps its colours.
 * It is declared exact, and is not. */
#include "fragmark/method.h"
#include "fragmark/technique.h"

static bool sign(uint32_t *bits, const fm_pair *pair, fm_prediction prediction)
{
    (void)bits;
    (void)pair;
    (void)prediction;
    return false;
}

static bool skip(const fm_tile_start *tile)
{
    return tile->previous_valid && tile->signature == tile->previous;
}

static const fm_technique technique = { .parts = FM_PART_SIGNATURES, .sign = sign, .skip = skip };

const fm_method_desc fm_method = {
    .abi = FM_ABI,
    .size_bytes = sizeof(fm_method_desc),
    .id = "tbr-unsigned",
    .title = "Unsigned",
    .citation = "a test",
    .version = "1",
    .traits = FM_TRAIT_EXACT,
    .feeds = FM_FEED_FRAMES,
    .keeps = FM_KEEPS_NEAREST,
    .technique = &technique,
};
