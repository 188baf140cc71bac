#include "common/cull_bucket.glsl"

// The far edge of the k-th occupied bucket becomes the pixel's boundary: k bits stand for k fragments or
// more, so none of the k nearest lies behind it (Lemma 2.1). With fewer than k bits nothing is culled.
void cull_count(uvec2 pixel)
{
    float near, far;
    gl_FragDepth = 1.0;
    if (!cull_range_of(pixel, near, far))
        return;
    uint wanted_bits = uint(K), bits = 0u, word = 0u;
    FM_LOOP for (; word < uint(FM_CULL_WORDS); ++word) {
        bits = fm_cull_map[cull_word(pixel, word)];
        uint count = uint(bitCount(bits));
        if (count >= wanted_bits)
            break;
        wanted_bits -= count;
    }
    if (word == uint(FM_CULL_WORDS))
        return;
    FM_LOOP for (; wanted_bits > 1u; --wanted_bits) // Kernighan: the lowest bit goes
        bits &= bits - 1u;
    gl_FragDepth = cull_far_edge(32u * word + uint(findLSB(bits)), near, far);
}
