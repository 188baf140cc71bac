// The window as a ring of sorted keys: fragments arrive nearly in order, so an insertion from the end
// moves few of them.
// Not below 32, or a compiler makes registers and selections of it (measured: README).
const uint RING = CAPACITY <= 32 ? 32u : CAPACITY <= 64 ? 64u : CAPACITY <= 128 ? 128u : 256u;
#if STRUCTURE == STRUCTURE_SHARED_ARRAY // its banks are the lanes', whatever place each is at
shared uvec2 ring_places[RING * FM_GROUP_LANES];
#define ring(i) ring_places[(i) * uint(FM_GROUP_LANES) + fm_lane]
#else
uvec2 ring_places[RING];
#define ring(i) ring_places[i]
#endif
uint ring_first, ring_count;
uvec2 ring_head, ring_tail; // its first and last key; while it is empty NO_KEY, and any

void window_clear()
{
    ring_first = 0u;
    ring_count = 0u;
    ring_head = NO_KEY;
    ring_tail = uvec2(0u);
}

uvec2 ring_at(uint i)
{
    return ring((ring_first + i) & (RING - 1u));
}

// The key's place among the first `at`, of which the last comes behind it: those behind it move.
uint ring_make_room(uvec2 key, uint at)
{
    uvec2 moved = ring_tail;
    FM_LOOP do {
        ring((ring_first + at) & (RING - 1u)) = moved;
        --at;
        moved = at > 0u ? ring_at(at - 1u) : uvec2(0u);
    } while (at > 0u && comes_before(key, moved));
    return at;
}

// Returns what falls out: NO_KEY while there is room.
uvec2 window_insert(uvec2 key)
{
    uvec2 fallen = NO_KEY;
    if (ring_count == uint(CAPACITY)) {
        fallen = ring_tail;
        if (!comes_before(key, fallen))
            return key;
        --ring_count;
        ring_tail = ring_count > 0u ? ring_at(ring_count - 1u) : uvec2(0u);
    }
    uint at = ring_count++;
    if (at > 0u && comes_before(key, ring_tail))
        at = ring_make_room(key, at);
    else
        ring_tail = key;
    ring((ring_first + at) & (RING - 1u)) = key;
    ring_head = at == 0u ? key : ring_head;
    return fallen;
}

uvec2 window_settle() // each is in its place already
{
    return NO_KEY;
}

uvec2 window_first()
{
    return ring_head;
}

void window_remove_first()
{
    ring_first = (ring_first + 1u) & (RING - 1u);
    --ring_count;
    ring_head = ring_count > 0u ? ring_at(0u) : NO_KEY;
}
