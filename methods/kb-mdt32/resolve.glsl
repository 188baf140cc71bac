#include "kb-mdt32/key.glsl"

void resolve(uvec2 pixel)
{
    FM_LOOP for (uint i = 0u; i < K; ++i) { // already in order
        uint slot = array_slot(pixel, i, K);
        if (keys[slot] == EMPTY)
            break;
        fm_emit(pixel, int(i), depth_of(keys[slot]), colours[slot]);
    }
}
