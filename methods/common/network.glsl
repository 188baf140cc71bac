// Up to BLOCK_MOST records sorted in registers, by Batcher's odd-even merge sort (1968): every index is a constant, so
// that no record lies in memory. Eight are sorted, then sixteen if there are more, then thirty-two.
//
// Keys go up in the order in which records are handed over: bits of the depth or, from the back, what they lack to
// infinity. Where there is no record the key is beyond all others.
//
// A method says, before it includes this, what a cursor is; by default the number of a record in its pixel:
//   uvec2 fragment_at(uvec2 pixel, uint cursor), void put_fragment(uvec2 pixel, uint cursor, uvec2 fragment)
//   uint next_cursor(uint cursor)
#include "common/unroll.glsl"
#define BLOCK_MOST 32u
#ifndef OWN_CURSORS
uint next_cursor(uint cursor)
{
    return cursor + 1u;
}
#endif

const uvec2 NO_RECORD = uvec2(0xFFFFFFFFu, 0u);

uvec2 keyed(uvec2 record) // its own inverse
{
#if FM_BACK_TO_FRONT
    record.x = FM_EMPTY_BITS - record.x;
#endif
    return record;
}

void emit_keyed(uvec2 pixel, uint i, uint count, uvec2 record)
{
    uint rank = FM_RANK(i, count);
    fm_emit(pixel, int(rank), uintBitsToFloat(keyed(record).x), record.y);
}

uvec2 block[BLOCK_MOST];
uint in_block;

void exchange(inout uvec2 before, inout uvec2 behind)
{
    bool is_wrong = behind.x < before.x;
    uvec2 first = is_wrong ? behind : before;
    behind = is_wrong ? before : behind;
    before = first;
}

#define EXCHANGE(i, j) exchange(block[i], block[j]);
// Of what is `step` apart: the second and the third, the fourth and the fifth, ...; one pair, three, seven, fifteen.
#define PAIRS_1(at, step)  EXCHANGE(at + 1u * step, at + 2u * step)
#define PAIRS_3(at, step)  PAIRS_1(at, step) PAIRS_1(at + 2u * step, step) PAIRS_1(at + 4u * step, step)
#define PAIRS_7(at, step)  PAIRS_3(at, step) PAIRS_1(at + 6u * step, step) PAIRS_3(at + 8u * step, step)
#define PAIRS_15(at, step) PAIRS_7(at, step) PAIRS_1(at + 14u * step, step) PAIRS_7(at + 16u * step, step)
// So many records, `step` apart, whose halves are sorted.
#define MERGE_2(at, step)  EXCHANGE(at, at + step)
#define MERGE_4(at, step)  MERGE_2(at, 2u * step) MERGE_2(at + step, 2u * step) PAIRS_1(at, step)
#define MERGE_8(at, step)  MERGE_4(at, 2u * step) MERGE_4(at + step, 2u * step) PAIRS_3(at, step)
#define MERGE_16(at, step) MERGE_8(at, 2u * step) MERGE_8(at + step, 2u * step) PAIRS_7(at, step)
#define MERGE_32(at, step) MERGE_16(at, 2u * step) MERGE_16(at + step, 2u * step) PAIRS_15(at, step)
// So many records in any order.
#define NETWORK_2(at)  EXCHANGE(at, at + 1u)
#define NETWORK_4(at)  NETWORK_2(at) NETWORK_2(at + 2u) MERGE_4(at, 1u)
#define NETWORK_8(at)  NETWORK_4(at) NETWORK_4(at + 4u) MERGE_8(at, 1u)
#define NETWORK_16(at) NETWORK_8(at) NETWORK_8(at + 8u) MERGE_16(at, 1u)

// Reads records from `cursor` on until `end`, and sorts them; the cursor behind the last.
#define LOAD(i)                                                                                                        \
    block[i] = NO_RECORD;                                                                                              \
    if (cursor != end) {                                                                                               \
        block[i] = keyed(fragment_at(pixel, cursor));                                                                  \
        cursor = next_cursor(cursor);                                                                                  \
        ++in_block;                                                                                                    \
    }
uint load_block(uvec2 pixel, uint cursor, uint end)
{
    in_block = 0u;
    EIGHT(LOAD, 0u)
    NETWORK_8(0u)
#if N > 8
    if (cursor != end) {
        EIGHT(LOAD, 8u)
        NETWORK_8(8u)
        MERGE_16(0u, 1u)
    }
#endif
#if N > 16
    if (cursor != end) {
        SIXTEEN(LOAD, 16u)
        NETWORK_16(16u)
        MERGE_32(0u, 1u)
    }
#endif
    return cursor;
}

#define EMIT(i)                                                                                                        \
    if (in_block > i)                                                                                                  \
        emit_keyed(pixel, rank + i, count, block[i]);
// From `rank` on, of `count`.
void emit_block(uvec2 pixel, uint rank, uint count)
{
    EIGHT(EMIT, 0u)
#if N > 8
    if (in_block > 8u) {
        EIGHT(EMIT, 8u)
    }
#endif
#if N > 16
    if (in_block > 16u) {
        SIXTEEN(EMIT, 16u)
    }
#endif
}
