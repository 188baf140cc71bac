#include "common/kept.glsl"

// A fragment takes the place of the farthest if it is nearer, unless its depth is there already.
// Nothing keeps two fragments of a pixel apart: both may take the same place, and then one is lost
// until the pass runs again. What is written is nearer than what was read, so slots never become
// farther than they were when the pass began, and a pass in which nothing changes comes.
void store(uvec2 pixel, float depth, uint colour)
{
    uvec2 fragment = fm_pack(depth, colour);
    uint farthest = 0u, farthest_bits = 0u;
    bool is_there = false;
    FM_LOOP for (uint i = 0u; i < K; ++i) {
        uint bits = kept_bits_at(pixel, i);
        is_there = is_there || bits == fragment.x;
        farthest = bits > farthest_bits ? i : farthest;
        farthest_bits = max(bits, farthest_bits);
    }
    if (is_there || fragment.x >= farthest_bits)
        return;
    keep_at(pixel, farthest, fragment);
    changed[0] = 1u; // all write the same
}
