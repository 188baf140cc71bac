#include "kb-ll/node.glsl"

void resolve(uvec2 pixel)
{
    uvec3 node = node_at(next_of(head_of(pixel)));
    FM_LOOP for (uint i = 0u; i < K && node.x != FM_EMPTY_BITS; ++i) { // in order
        emit_node(pixel, node, i);
        node = node_at(node.z);
    }
}
