#include "peer-array/put_record.glsl"

// Slot 0 is what a fragment must beat: infinity until the array is full.
void clear(uvec2 pixel)
{
    fm_store_counters(pixel, uvec4(0u));
    fm_store_locks(pixel, uvec4(0u));
    put_record(pixel, 0u, uvec2(FM_EMPTY_BITS, 0u));
}
