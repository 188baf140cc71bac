#include "common/cull_bucket.glsl"

void cull_clear(uvec2 pixel)
{
    uint i = 2u * fm_pixel_index(pixel);
    fm_cull_range[i] = 0u;
    fm_cull_range[i + 1u] = 0u;
    FM_LOOP for (uint word = 0u; word < uint(FM_CULL_WORDS); ++word)
        fm_cull_map[cull_word(pixel, word)] = 0u;
}
