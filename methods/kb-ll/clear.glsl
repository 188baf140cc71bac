#include "kb-ll/node.glsl"

void clear(uvec2 pixel)
{
    uint head = head_of(pixel), tail = head + NODE_WORDS;
    nodes[head + DEPTH] = 0u;
    nodes[head + NEXT] = tail;
    nodes[tail + DEPTH] = FM_EMPTY_BITS;
    nodes[tail + NEXT] = tail;
    if (pixel == uvec2(0u)) {
        allocated[0] = 2u * NODE_WORDS * uint(FM_PIXELS); // behind the sentinels
        allocated[1] = 0u;
    }
}
