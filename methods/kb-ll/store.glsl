#include "kb-ll/node.glsl"

// All fragments collide here; the counter gives each a node of its own, before it is known whether the
// fragment is among the k nearest.
uint take_node()
{
    uint node = atomicAdd(allocated[0], NODE_WORDS);
    if (node + NODE_WORDS <= fm_length_nodes)
        return node;
    atomicAdd(allocated[1], NODE_WORDS); // the pool grows by that many, and the frame runs again
    return 0u;
}

// The sorted list of a pixel, without a lock. Nodes are never taken out: one that had k before it has
// them for ever, and `before` stays a good place to go on from. Fragments of a pixel collide in the
// exchange of before's link: it succeeds only if nothing was linked there since the link was read, and
// then the list stays sorted; who fails reads the link again. One fails only because another got in,
// so K + N rounds are enough.
void store(uvec2 pixel, float depth, uint colour)
{
    uint node = take_node();
    if (node == 0u)
        return;
    uvec2 fragment = fm_pack(depth, colour);
    nodes[node + DEPTH] = fragment.x;
    nodes[node + COLOUR] = fragment.y;
    uint before = head_of(pixel), passed = 0u;
    bool is_linked = false;
    FM_LOOP for (uint i = 0u; i < uint(K) + uint(N) && passed < K && !is_linked; ++i) {
        uint link = nodes[before + NEXT];
        if (nodes[link + DEPTH] > fragment.x) {
            nodes[node + NEXT] = link;
            fm_fence(); // the node is whole before others can reach it
            is_linked = atomicCompSwap(nodes[before + NEXT], link, node) == link;
        } else {
            before = link;
            ++passed;
        }
    }
    if (!is_linked && passed < K)
        fm_lost(pixel);
}
