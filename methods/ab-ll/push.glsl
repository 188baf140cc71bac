#include "ab-ll/node.glsl"

// Puts a fragment in front of a list.
void push(uint list, float depth, uint colour)
{
    // All fragments collide here; the counter gives each a node of its own.
    uint node = atomicAdd(allocated[0], NODE_WORDS);
    if (node + NODE_WORDS > fm_length_nodes) {
        atomicAdd(allocated[1], NODE_WORDS); // the pool grows by that many, and the frame runs again
        return;
    }
    uvec2 fragment = fm_pack(depth, colour);
    nodes[node] = fragment.x;
    nodes[node + 1u] = fragment.y;
    // Fragments of a list collide; each exchange links one node in front. No one walks the list yet.
    nodes[node + 2u] = atomicExchange(heads[list], node + 1u);
}
