// Heap sort where a pixel's fragments lie: any number of them, no memory but theirs, n log n in any order.
// An invocation has its pixel for itself. Where a device would end its loops (FM_RESUMES) it is done in runs.
// The method defines, before it includes this, where the i-th is:
//   uvec2 fragment_at(uvec2 pixel, uint i)
//   void put_fragment(uvec2 pixel, uint i, uvec2 fragment)
void sift_down(uvec2 pixel, uint root, uint end)
{
    uvec2 item = fragment_at(pixel, root);
    uint child = 2u * root + 1u;
    FM_LOOP while (child < end) {
        uvec2 below = fragment_at(pixel, child);
        if (child + 1u < end) {
            uvec2 beside = fragment_at(pixel, child + 1u);
            child += beside.x > below.x ? 1u : 0u;
            below = beside.x > below.x ? beside : below;
        }
        if (below.x <= item.x)
            break;
        put_fragment(pixel, root, below);
        root = child;
        child = 2u * root + 1u;
    }
    put_fragment(pixel, root, item);
}

#if FM_RESUMES
#include "common/sort_in_runs.glsl"

void emit_in_place(uvec2 pixel, uint count)
{
    emit_in_runs(pixel, count, count);
}
#else
void sort_in_place(uvec2 pixel, uint count)
{
    FM_LOOP for (uint root = count / 2u; root > 0u; --root)
        sift_down(pixel, root - 1u, count);
    FM_LOOP for (uint end = count; end > 1u; --end) {
        uvec2 farthest = fragment_at(pixel, 0u);
        put_fragment(pixel, 0u, fragment_at(pixel, end - 1u));
        put_fragment(pixel, end - 1u, farthest);
        sift_down(pixel, 0u, end - 1u);
    }
}

void emit_in_place(uvec2 pixel, uint count)
{
    sort_in_place(pixel, count);
    FM_LOOP for (uint i = 0u; i < count; ++i) {
        uint rank = FM_RANK(i, count);
        uvec2 fragment = fragment_at(pixel, rank);
        fm_emit(pixel, int(rank), uintBitsToFloat(fragment.x), fragment.y);
    }
}
#endif
