#include "kb-mdt32/key.glsl"

void clear(uvec2 pixel)
{
    FM_LOOP for (uint i = 0u; i < K; ++i) {
        keys[array_slot(pixel, i, K)] = EMPTY;
        colours[array_slot(pixel, i, K)] = 0u;
    }
}
