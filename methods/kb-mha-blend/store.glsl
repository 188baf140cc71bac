#include "kb-mha/code.glsl"
#include "kb/insert.glsl"

vec4 four(uint came[CODE_WORDS], uint went[CODE_WORDS], uint first)
{
    vec4 sum;
    FM_LOOP for (uint i = 0u; i < 4u; ++i)
        sum[i] = float(int(came[first + i]) - int(went[first + i]));
    return sum;
}

// As kb-mha, and what came and what it pushed out is told in one blended write, which is whole and in turn. Floats add
// whole numbers exactly below 2^24: the codes of 255 records that arrived and were not pushed out.
void store(uvec2 pixel, float depth, uint colour)
{
    uvec2 fragment = fm_pack(depth, colour), evicted = insert(pixel, fragment);
    bool is_full = evicted.x != FM_EMPTY_BITS;
    uint came[CODE_WORDS] = code_of(fragment), went[CODE_WORDS] = code_of(evicted);
    FM_LOOP for (uint word = 0u; word < CODE_WORDS; ++word)
        went[word] = is_full ? went[word] : 0u;
    fm_target_powers = four(came, went, 0u);
    fm_target_values = four(came, went, 4u);
    fm_target_products = four(came, went, 8u);
    fm_target_evicted = is_full ? uintBitsToFloat(evicted.x) : 2.0;
}
