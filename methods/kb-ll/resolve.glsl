#include "kb-ll/node.glsl"

void resolve(uvec2 pixel)
{
    uint node = nodes[head_of(pixel) + NEXT];
    FM_LOOP for (uint i = 0u; i < K && nodes[node + DEPTH] != FM_EMPTY_BITS; ++i) { // in order
        fm_emit(pixel, int(i), uintBitsToFloat(nodes[node + DEPTH]), nodes[node + COLOUR]);
        node = nodes[node + NEXT];
    }
}
