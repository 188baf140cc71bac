#include "ab-ll/node.glsl"
#include "ab-ll-bucket/bucket.glsl"
#define SORT_CAPACITY N
#include "common/sort.glsl"

// Bucket by bucket: what lies in one is nearer than all in the next.
void resolve(uvec2 pixel)
{
    uint rank = 0u;
    FM_LOOP for (uint bucket = 0u; bucket < BUCKETS; ++bucket) {
        uint link = heads[fm_pixel_index(pixel) * BUCKETS + bucket];
        uint count = 0u;
        FM_LOOP while (link != END_OF_LIST && count < N) {
            sorted[count++] = uvec2(nodes[link - 1u], nodes[link]);
            link = nodes[link + 1u];
        }
        sort_fragments(count);
        FM_LOOP for (uint i = 0u; i < count; ++i)
            fm_emit(pixel, int(rank++), uintBitsToFloat(sorted[i].x), sorted[i].y);
    }
}
