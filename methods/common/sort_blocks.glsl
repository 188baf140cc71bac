// Register-based block sort: P. Knowles, G. Leach, F. Zambetta, Fast Sorting for Exact OIT of Complex Scenes, The Visual
// Computer 30, 2014, doi:10.1007/s00371-014-0956-z. Up to 32 records are sorted in registers and handed over from
// there. More are sorted in blocks of 32, each written back to where it was read, and then merged: the head of each
// block lies in registers, the nearest head is handed over and the next one of its block read. No array of N records
// is needed. An invocation has its pixel for itself. Cursors and records as network.glsl has them.
#include "common/network.glsl"

#define BLOCKS ((N + 31u) / 32u)

#if N > 32
uvec2 fronts[BLOCKS];
uint front_cursors[BLOCKS], fronts_left[BLOCKS]; // where a head lies, and how many its block has, the head among them

#define STORE(i)                                                                                                       \
    if (in_block > i) {                                                                                                \
        put_fragment(pixel, cursor, keyed(block[i]));                                                                  \
        cursor = next_cursor(cursor);                                                                                  \
    }
void store_block(uvec2 pixel, uint cursor, uint number)
{
    for (uint i = 0u; i < BLOCKS; ++i) { // unrolled, as all loops over heads: their indices are constants
        bool is_it = i == number;
        fronts[i] = is_it ? block[0] : fronts[i];
        front_cursors[i] = is_it ? cursor : front_cursors[i];
        fronts_left[i] = is_it ? in_block : fronts_left[i];
    }
    THIRTY_TWO(STORE, 0u)
}

uvec2 take_head(uvec2 pixel)
{
    uint from = 0u, cursor = front_cursors[0], rest = fronts_left[0];
    uvec2 taken = fronts[0];
    for (uint i = 1u; i < BLOCKS; ++i) {
        bool is_before = fronts[i].x < taken.x;
        from = is_before ? i : from;
        taken = is_before ? fronts[i] : taken;
        cursor = is_before ? front_cursors[i] : cursor;
        rest = is_before ? fronts_left[i] : rest;
    }
    uvec2 next = NO_RECORD;
    if (rest > 1u) {
        cursor = next_cursor(cursor);
        next = keyed(fragment_at(pixel, cursor));
    }
    for (uint i = 0u; i < BLOCKS; ++i) {
        bool is_it = i == from;
        fronts[i] = is_it ? next : fronts[i];
        front_cursors[i] = is_it ? cursor : front_cursors[i];
        fronts_left[i] = is_it ? rest - 1u : fronts_left[i];
    }
    return taken;
}
#endif

// Of the records from `cursor` to `end`, `count` in all, the ranks from `rank` on; the rank behind the last. Where ranks
// are handed over from the front only, `count` may be 0: not known.
uint emit_by_network(uvec2 pixel, uint cursor, uint end, uint rank, uint count)
{
#if N > 32
    uint number = 0u, records = 0u;
    for (uint i = 0u; i < BLOCKS; ++i)
        fronts[i] = NO_RECORD;
    FM_LOOP do {
        uint first = cursor;
        cursor = load_block(pixel, first, end);
        if (number > 0u || cursor != end)
            store_block(pixel, first, number);
        records += in_block;
        ++number;
    } while (cursor != end && number < BLOCKS);
    if (number > 1u) {
        FM_LOOP for (uint i = 0u; i < records; ++i)
            emit_keyed(pixel, rank + i, count, take_head(pixel));
        return rank + records;
    }
#else
    load_block(pixel, cursor, end);
#endif
    emit_block(pixel, rank, count);
    return rank + in_block;
}
