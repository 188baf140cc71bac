#include "ab-ll/nodes.glsl"

// Puts a fragment in front of a list.
void push(uint list, float depth, uint colour)
{
    // All fragments collide here; the counter gives each a node of its own.
    uint node = atomicAdd(allocated[0], NODE_STEP);
    if (node + NODE_STEP > fm_length_nodes) {
        atomicAdd(allocated[1], NODE_STEP); // the pool grows by that many, and the frame runs again
        return;
    }
    uvec2 fragment = fm_pack(depth, colour);
    uint link = node + 1u;
    // Fragments of a list collide; each exchange links one node in front. No one walks the list yet.
    uint next = atomicExchange(heads[list], link);
    set_node(link, fragment, next);
}
