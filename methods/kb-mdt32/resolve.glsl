#include "kb-mdt32/key.glsl"

uint colour_at(uvec2 pixel, uint i)
{
#if ARRAY_IS_IMAGE
    return fm_load_colours(pixel, i).x;
#else
    return colours[array_slot(pixel, i, K)];
#endif
}

void resolve(uvec2 pixel)
{
    FM_LOOP for (uint i = 0u; i < K; ++i) { // already in order
        uint key = key_at(pixel, i);
        if (key == EMPTY)
            break;
        fm_emit(pixel, int(i), depth_of(key), colour_at(pixel, i));
    }
}
