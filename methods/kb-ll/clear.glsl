#include "kb-ll/node.glsl"

void clear(uvec2 pixel)
{
    uint head = head_of(pixel), tail = head + NODE_STEP;
    set_node(head, uvec2(0u), tail);
    set_node(tail, uvec2(FM_EMPTY_BITS, 0u), tail);
    if (pixel == uvec2(0u)) {
        allocated[0] = 2u * NODE_STEP * uint(FM_PIXELS); // behind the sentinels
        allocated[1] = 0u;
    }
}
