// What resolve does with a pixel's records in sorted[], by the sums that are told of it:
//   uint sum_at(uvec2 pixel, uint word)     of codes of all that arrived less all that was pushed out, modulo P
//   uint nearest_evicted(uvec2 pixel)       depth bits; above all depths if nothing was pushed out
#define SORT_CAPACITY K
#include "common/sort.glsl"
#include "kb-mha/decode.glsl"

// Leaves out what is empty.
void whole_records(inout uint count)
{
    uint to = 0u;
    FM_LOOP for (uint from = 0u; from < count; ++from)
        if (sorted[from].x != FM_EMPTY_BITS)
            sorted[to++] = sorted[from];
    count = to;
}
uvec2 forged_out = uvec2(FM_EMPTY_BITS, 0u);
#if FORGE > 0
#include "kb-mha/forge.glsl"
#endif

uint load_records(uvec2 pixel)
{
    uint count = K;
    FM_LOOP for (uint i = 0u; i < K; ++i)
        sorted[i] = kept_at(pixel, i);
    whole_records(count);
#if FORGE > 0
    forge(pixel, count);
#endif
    return count;
}

// The sums, less what is forged as pushed out.
uint told_at(uvec2 pixel, uint word)
{
    uint sum = sum_at(pixel, word);
#if FORGE == FORGE_EVICT
    uint gone[CODE_WORDS] = code_of(forged_out);
    sum = forged_out.x == FM_EMPTY_BITS ? sum : minus(sum, gone[word]);
#endif
    return sum;
}

// What the sums have and the records have not. False: nothing, and so no record is damaged.
bool find_damage(out uint differs[CODE_WORDS], uvec2 pixel, uint count)
{
    uint any = 0u;
    FM_LOOP for (uint word = 0u; word < CODE_WORDS; ++word)
        differs[word] = told_at(pixel, word);
    FM_LOOP for (uint i = 0u; i < count; ++i) {
        uint code[CODE_WORDS] = code_of(sorted[i]);
        FM_LOOP for (uint word = 0u; word < CODE_WORDS; ++word)
            differs[word] = minus(differs[word], code[word]);
    }
    FM_LOOP for (uint word = 0u; word < CODE_WORDS; ++word)
        any |= differs[word];
    return any != 0u;
}

// As many copies as are there: what was told as pushed out twice may not be there at all.
void take_out(uint count, damage found)
{
    int wanted = -found.weight;
    FM_LOOP for (uint i = 0u; i < count; ++i)
        if (sorted[i] == found.record && wanted > 0) {
            sorted[i].x = FM_EMPTY_BITS;
            --wanted;
        }
}
// Among records in order; of more than K the nearest stay.
void add(inout uint count, damage found)
{
    uint copies = uint(clamp(found.weight, 0, K)), at = count;
    FM_LOOP while (copies > 0u && at > 0u && sorted[at - 1u].x > found.record.x) {
        --at;
        if (at + copies < K)
            sorted[at + copies] = sorted[at];
    }
    FM_LOOP for (uint i = at; i < min(at + copies, uint(K)); ++i)
        sorted[i] = found.record;
    count = min(count + copies, uint(K));
}

// True: the first `count` of sorted[] are the pixel's nearest, in order. What arrived is what is here and what was
// pushed out, and of that nothing is nearer than the farthest here: so it does not matter by which lists, torn or
// doubled or stale, it was decided what to push out.
bool are_nearest(uvec2 pixel, uint count)
{
    uint farthest = count == K ? sorted[K - 1u].x : FM_EMPTY_BITS;
    return farthest <= min(nearest_evicted(pixel), forged_out.x);
}

bool repair(uvec2 pixel, inout uint count)
{
    uint differs[CODE_WORDS];
    damage one, other;
    bool is_damaged = find_damage(differs, pixel, count);
    bool is_known = !is_damaged || decode(one, other, differs);
    bool is_mended = is_damaged && is_known;
    if (is_mended) { // in loops, so that the code is there once
        FM_LOOP for (uint i = 0u; i < 2u; ++i)
            take_out(count, i == 0u ? one : other);
        whole_records(count);
    }
    sort_fragments(count);
    if (is_mended)
        FM_LOOP for (uint i = 0u; i < 2u; ++i)
            add(count, i == 0u ? one : other);
    bool is_right = is_known && are_nearest(pixel, count);
    if (!is_right)
        fm_unrepaired();
    else if (is_damaged)
        fm_repaired();
    return is_right;
}

void resolve(uvec2 pixel)
{
    uint count = load_records(pixel);
    bool is_right = repair(pixel, count);
    if (is_right || UNREPAIRED != UNREPAIRED_DROP)
        emit_sorted(pixel, count);
}
