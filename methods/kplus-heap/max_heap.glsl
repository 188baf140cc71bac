// A max-heap: the root, slot 0, is the farthest. Slots are filled from the last to the root, each fragment going
// down from its own: so the heap below is whole all along, and infinity is the root until there are K (R. W. Floyd,
// Algorithm 245: Treesort 3, CACM 7, 1964). A slot has CHILDREN others below it: with 4 a fragment waits for
// half as many reads that hang on each other as with 2.
#ifndef CHILDREN
#define CHILDREN 2
#endif

// The slot for a fragment that comes to `count` others, or is nearer than the root, O(log k): the farthest child
// moves up. Where all K are there then, `farthest_bits` is the root's depth.
uint place(uvec2 pixel, uint count, uvec2 fragment, inout uint farthest_bits)
{
    uint at = K - 1u - min(count, K - 1u), child = uint(CHILDREN) * at + 1u;
    FM_LOOP while (child < K) {
        uvec2 children[CHILDREN], farthest;
        uint from = child;
        for (uint i = 0u; i < uint(CHILDREN); ++i)
            children[i] = kept_at(pixel, min(child + i, K - 1u)); // the last level may be short
        farthest = children[0];
        for (uint i = 1u; i < uint(CHILDREN); ++i) {
            bool is_farther = children[i].x > farthest.x;
            from = is_farther ? child + i : from;
            farthest = is_farther ? children[i] : farthest;
        }
        if (farthest.x <= fragment.x)
            break;
        keep_at(pixel, at, farthest);
        farthest_bits = at == 0u ? farthest.x : farthest_bits;
        at = from;
        child = uint(CHILDREN) * at + 1u;
    }
    return at;
}
