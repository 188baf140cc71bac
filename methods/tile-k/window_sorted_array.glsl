// The window as a ring of sorted keys: fragments arrive nearly in order, so an insertion from the end
// moves few of them.
// Not below 32, or a compiler makes registers and selections of it (measured: README).
const uint RING = CAPACITY <= 32 ? 32u : CAPACITY <= 64 ? 64u : CAPACITY <= 128 ? 128u : 256u;
uvec2 ring[RING];
uint ring_first, ring_count;

void window_clear()
{
    ring_first = 0u;
    ring_count = 0u;
}

uvec2 ring_at(uint i)
{
    return ring[(ring_first + i) & (RING - 1u)];
}

// Returns what falls out: NO_KEY while there is room.
uvec2 window_insert(uvec2 key)
{
    uvec2 fallen = NO_KEY;
    if (ring_count == uint(CAPACITY)) {
        fallen = ring_at(ring_count - 1u);
        if (!comes_before(key, fallen))
            return key;
        --ring_count;
    }
    uint at = ring_count++;
    FM_LOOP while (at > 0u && comes_before(key, ring_at(at - 1u))) {
        ring[(ring_first + at) & (RING - 1u)] = ring_at(at - 1u);
        --at;
    }
    ring[(ring_first + at) & (RING - 1u)] = key;
    return fallen;
}

uvec2 window_first()
{
    return ring_count > 0u ? ring[ring_first] : NO_KEY;
}

void window_remove_first()
{
    ring_first = (ring_first + 1u) & (RING - 1u);
    --ring_count;
}
