// Up to 32 records are sorted in registers and handed over from there; more as the papers do it. Cursors and records as
// network.glsl has them.
#include "common/network.glsl"
#if N > 32
#define SORT_CAPACITY N
#include "common/sort.glsl"
#endif

// Of the records from `cursor` to `end`, `count` in all, the ranks from `rank` on; the rank behind the last. Where ranks
// are handed over from the front only, `count` may be 0: not known.
uint emit_by_network(uvec2 pixel, uint cursor, uint end, uint rank, uint count)
{
#if N > 32
    if (count > BLOCK_MOST || load_block(pixel, cursor, end) != end) {
        uint records = 0u;
        FM_LOOP for (; cursor != end && records < N; cursor = next_cursor(cursor))
            sorted[records++] = fragment_at(pixel, cursor);
        sort_fragments(records);
        FM_LOOP for (uint i = 0u; i < records; ++i) {
            uint at = FM_RANK(i, records);
            fm_emit(pixel, int(rank + at), uintBitsToFloat(sorted[at].x), sorted[at].y);
        }
        return rank + records;
    }
#else
    load_block(pixel, cursor, end);
#endif
    emit_block(pixel, rank, count);
    return rank + in_block;
}
