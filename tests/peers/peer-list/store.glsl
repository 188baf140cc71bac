// A node is 16 bytes, written at once: colour, depth bits, and the next node's number plus one; 0 ends.
void store(uvec2 pixel, float depth, uint colour)
{
    // All fragments collide in the counter, which gives each a node of its own.
    uint node = atomicAdd(allocated[0], 1u);
    if (node >= fm_length_nodes) {
        atomicAdd(allocated[1], 1u); // the pool grows by that many, and the frame runs again
        return;
    }
    // Fragments of a pixel collide; each exchange links one node in front. No one walks the list yet.
    uint next = atomicExchange(heads[fm_pixel_index(pixel)], node + 1u);
    nodes[node] = uvec4(colour, fm_pack(depth, colour).x, next, 0u);
}
