// Where a key belongs among the K keys of a pixel that the multi depth test keeps: they ascend and only ever
// decrease. Before it includes this a method defines KEY, the type of a key, and KEY key_at(uvec2 pixel, uint i).
//
// A chain may begin at any slot whose predecessor was once read as smaller than its key. Slots only decrease,
// so it stays smaller, and the keys ascend as they did. Other chains may be under way meanwhile: a slot read
// too early is read as larger, and a chain that begins too early goes through slots that it does not change.

// k/2 or 0, by one read.
uint slot_by_half(uvec2 pixel, KEY key)
{
    return key > key_at(pixel, K / 2u) ? K / 2u : 0u;
}

// The first of the slots before the last whose key is not below this one, else the last: O(log k).
uint slot_by_search(uvec2 pixel, KEY key)
{
    uint first = 0u, end = K - 1u;
    FM_LOOP while (first < end) {
        uint middle = (first + end) / 2u;
        bool is_below = key_at(pixel, middle) < key;
        first = is_below ? middle + 1u : first;
        end = is_below ? end : middle;
    }
    return first;
}

#ifdef START
// Where the chain of a key begins that is below the last slot's, as option start says: at slot 0, as published;
// at k/2 if that slot is below the key; at the first slot that is not below it. A short chain is done before
// the search would be.
const uint SEARCH_K = 16u;

uint chain_start(uvec2 pixel, KEY key)
{
#if START == START_BINARY
    return slot_by_search(pixel, key);
#elif START == START_HALF
    return slot_by_half(pixel, key);
#elif START == START_AUTO
    return K >= SEARCH_K ? slot_by_search(pixel, key) : 0u;
#else
    return 0u;
#endif
}
#endif
