#include "ab-ll/node.glsl"

void resolve(uvec2 pixel)
{
    uint link = heads[fm_pixel_index(pixel)];
    uvec2 nearest = uvec2(FM_EMPTY_BITS, 0u);
    FM_LOOP while (link != END_OF_LIST) {
        if (nodes[link - 1u] < nearest.x)
            nearest = uvec2(nodes[link - 1u], nodes[link]);
        link = nodes[link + 1u];
    }
    if (nearest.x != FM_EMPTY_BITS)
        fm_emit(pixel, 0, uintBitsToFloat(nearest.x), nearest.y);
}
