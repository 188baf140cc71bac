// Heap sort where the list lies: any length, no private array, n log n in any order.
void sift_down(uint first, uint root, uint end)
{
    uvec2 item = fragments[first + root];
    uint child = 2u * root + 1u;
    FM_LOOP while (child < end) {
        if (child + 1u < end && fragments[first + child + 1u].x > fragments[first + child].x)
            ++child;
        if (fragments[first + child].x <= item.x)
            break;
        fragments[first + root] = fragments[first + child];
        root = child;
        child = 2u * root + 1u;
    }
    fragments[first + root] = item;
}

void resolve(uvec2 pixel)
{
    uint i = fm_pixel_index(pixel);
    uint count = counters[i], first = count > 0u ? offsets[i] : 0u;
    FM_LOOP for (uint root = count / 2u; root > 0u; --root)
        sift_down(first, root - 1u, count);
    FM_LOOP for (uint end = count; end > 1u; --end) {
        uvec2 farthest = fragments[first];
        fragments[first] = fragments[first + end - 1u];
        fragments[first + end - 1u] = farthest;
        sift_down(first, 0u, end - 1u);
    }
    FM_LOOP for (uint rank = 0u; rank < count; ++rank)
        fm_emit(pixel, int(rank), uintBitsToFloat(fragments[first + rank].x),
                fragments[first + rank].y);
}
