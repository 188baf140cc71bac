#include "peer-array/order.glsl"
#include "peer-array/put_record.glsl"

// Read without the lock: a full heap's root only comes nearer, so a stale one culls too little. Before, the
// root may be too near: whoever reads a full count must read a root of that time or later.
bool is_nearer(uvec2 pixel, uint bits)
{
    uint count = fm_load_counters(pixel).x;
    order_images();
    return count < K || bits < record_at(pixel, 0u).x;
}

// One more record at the end: ancestors that are nearer move down.
void sift_up(uvec2 pixel, uint at, uvec2 fragment)
{
    FM_LOOP while (at > 0u) {
        uint parent = (at - 1u) / 2u;
        uvec2 record = record_at(pixel, parent);
        if (record.x >= fragment.x)
            break;
        put_record(pixel, at, record);
        at = parent;
    }
    put_record(pixel, at, fragment);
}

// In place of the root: the farther child moves up.
void sift_down(uvec2 pixel, uvec2 fragment)
{
    uint at = 0u, child = 1u;
    FM_LOOP while (child < K) {
        uint sibling = min(child + 1u, K - 1u); // the last level may be short
        uvec2 record = record_at(pixel, child), other = record_at(pixel, sibling);
        child = other.x > record.x ? sibling : child;
        record = other.x > record.x ? other : record;
        if (record.x <= fragment.x)
            break;
        put_record(pixel, at, record);
        at = child;
        child = 2u * at + 1u;
    }
    put_record(pixel, at, fragment);
}

// A max-heap in slots from 0 on, built from the first fragment: O(log k) for each.
void insert(uvec2 pixel, uvec2 fragment)
{
    uint count = fm_load_counters(pixel).x;
    if (count < K) {
        sift_up(pixel, count, fragment);
        if (count + 1u == K)
            order_images();
        fm_store_counters(pixel, uvec4(count + 1u));
    } else if (fragment.x < record_at(pixel, 0u).x) {
        sift_down(pixel, fragment);
    }
}

#include "peer-array/locked_store.glsl"
