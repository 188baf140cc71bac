#include "common/cull_map.glsl"

void cull_clear(uvec2 pixel)
{
    FM_LOOP for (uint word = 0u; word < uint(FM_CULL_WORDS); ++word)
        fm_cull_map[cull_word(pixel, word)] = 0u;
}
