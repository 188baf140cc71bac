#include "kb-mha/code.glsl"
#include "kb/insert.glsl"
#include "kb-mha/sums.glsl"

// KB, where nothing keeps two fragments of a pixel apart. What came and what it pushed out is told by atomics, which
// no race can damage: sums and a maximum, so that their order does not matter.
void store(uvec2 pixel, float depth, uint colour)
{
    uvec2 fragment = fm_pack(depth, colour), evicted = insert(pixel, fragment);
    bool is_full = evicted.x != FM_EMPTY_BITS;
    if (is_full)
        atomicMax(sums[sum_slot(pixel, EVICTED)], ~evicted.x);
    if (evicted == fragment)
        return; // the two codes cancel
    uint came[CODE_WORDS] = code_of(fragment), went[CODE_WORDS] = code_of(evicted);
    FM_LOOP for (uint word = 0u; word < CODE_WORDS; ++word)
        atomicAdd(sums[sum_slot(pixel, word)], came[word] - (is_full ? went[word] : 0u));
}
