#include "kb-mdt64/key.glsl"

void resolve(uvec2 pixel)
{
    FM_LOOP for (uint i = 0u; i < K; ++i) { // already in order
        uvec2 colour_depth = unpackUint2x32(key_at(pixel, i));
        if (colour_depth.y == 0xFFFFFFFFu)
            break;
        fm_emit(pixel, int(i), uintBitsToFloat(colour_depth.y), colour_depth.x);
    }
}
