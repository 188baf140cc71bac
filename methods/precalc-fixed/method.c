#include "fragmark/method.h"

const fm_method_desc fm_method = {
    .abi = FM_ABI,
    .size_bytes = sizeof(fm_method_desc),
    .id = "precalc-fixed",
    .title = "PreCalc_Fixed",
    .citation = "Peeper 2008, Prefix sum pass to linearize A-buffer storage; as measured by "
                "Vasilakis, Fudos 2012, S-buffer, doi:10.2312/conf/EG2012/short/101-104",
    .version = "1",
    .traits = FM_TRAIT_EXACT | FM_TRAIT_SORTS_IN_RESOLVE | FM_TRAIT_EMITS_EITHER,
    .keeps = FM_KEEPS_ALL,
    .family = FM_FAMILY_A_BUFFER,
    .marker = FM_MARKER_DIAMOND,
    .resources = {
        { .name = "counters", .extent = { .per_pixel = 1 }, .used = { .per_pixel = 1 } },
        { .name = "addresses", .extent = { .per_pixel = 1 }, .used = { .per_pixel = 1 } },
        { .name = "fragments", .element = FM_ELEMENT_UVEC2, .extent = { .per_pixel_n = 1 },
          .used = { .per_fragment = 1 } },
    },
    .passes = {
        { .name = "reference", .kind = FM_PASS_PIXELS, .shader = "reference.glsl",
          .writes = { "counters", "addresses" } },
        { .name = "store", .shader = "store.glsl", .reads = { "addresses" },
          .writes = { "counters", "fragments" } },
        { .name = "resolve", .kind = FM_PASS_PIXELS, .shader = "resolve.glsl", .emits = true,
          .resumes = FM_RESUMES_BY_N,
          .reads = { "counters", "addresses" }, .writes = { "fragments" } },
    },
};
