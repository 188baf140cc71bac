#include "kb-ll/node.glsl"

// All fragments collide here; the counter gives each a node of its own, before it is known whether the
// fragment is among the k nearest.
uint take_node()
{
    uint node = atomicAdd(allocated[0], NODE_STEP);
    if (node + NODE_STEP <= fm_length_nodes)
        return node + 1u;
    atomicAdd(allocated[1], NODE_STEP); // the pool grows by that many, and the frame runs again
    return END_OF_LIST;
}

// The sorted list of a pixel, without a lock. Nodes are never taken out: one that had k before it has
// them for ever, and `before` stays a good place to go on from. Fragments of a pixel collide in the
// exchange of before's link: it succeeds only if nothing was linked there since the link was read, and
// then the list stays sorted; who fails has the link as it is now. One fails only because another got in,
// so K + N rounds are enough.
void store(uvec2 pixel, float depth, uint colour)
{
    uint node = take_node();
    if (node == END_OF_LIST)
        return;
    uvec2 fragment = fm_pack(depth, colour);
    uint before = head_of(pixel), link = next_of(before), passed = 0u;
    bool is_linked = false;
    FM_LOOP for (uint i = 0u; i < uint(K) + uint(N) && passed < K && !is_linked; ++i) {
        uvec3 behind = node_at(link);
        if (behind.x > fragment.x) {
            set_node(node, fragment, link);
            fm_fence(); // the node is complete before others can reach it
            uint found = atomicCompSwap(next_word(before), link, node);
            is_linked = found == link;
            link = found;
        } else {
            before = link;
            link = behind.z;
            ++passed;
        }
    }
    if (!is_linked && passed < K)
        fm_lost(pixel);
}
