#include "peer-array/order.glsl"
#include "peer-array/put_record.glsl"

// Read without the lock: slot 0 only ever comes nearer, so a stale one culls too little.
bool is_nearer(uvec2 pixel, uint bits)
{
    return bits < record_at(pixel, 0u).x;
}

// K-1 records in any order, from the back, and in slot 0 the farthest of all k.
void insert(uvec2 pixel, uvec2 fragment)
{
    uint count = fm_load_counters(pixel).x;
    if (count + 1u < K) { // O(1)
        put_record(pixel, K - 1u - count, fragment);
        fm_store_counters(pixel, uvec4(count + 1u));
        return;
    }
    if (!is_nearer(pixel, fragment.x))
        return;
    uint slot = 0u;
    uvec2 farthest = fragment;
    FM_LOOP for (uint other = 1u; other < K; ++other) { // O(k)
        uvec2 record = record_at(pixel, other);
        slot = record.x > farthest.x ? other : slot;
        farthest = record.x > farthest.x ? record : farthest;
    }
    if (slot > 0u)
        put_record(pixel, slot, fragment);
    put_record(pixel, 0u, farthest);
    if (count < K)
        fm_store_counters(pixel, uvec4(uint(K)));
}

#include "peer-array/locked_store.glsl"
