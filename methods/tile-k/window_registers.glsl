// The window as CAPACITY sorted keys that never leave registers: every index is a constant, an insertion
// compares with all of them. For devices that run all lanes through every branch anyway. No comparison waits
// for another one.
uvec2 window[CAPACITY];

void window_clear()
{
    for (int i = 0; i < CAPACITY; ++i)
        window[i] = NO_KEY;
}

// Returns what falls out: NO_KEY while there is room.
uvec2 window_insert(uvec2 key)
{
    bool is_before = comes_before(key, window[CAPACITY - 1]);
    if (LANES == 32 && !is_before) // a way round for lanes that branch
        return key;
    uvec2 fallen = is_before ? window[CAPACITY - 1] : key;
    for (int i = CAPACITY - 1; i > 0; --i) {
        bool is_before_next = comes_before(key, window[i - 1]);
        uvec2 moved = is_before_next ? window[i - 1] : key;
        window[i] = is_before ? moved : window[i];
        is_before = is_before_next;
    }
    window[0] = is_before ? key : window[0];
    return fallen;
}

uvec2 window_settle() // each is in its place already
{
    return NO_KEY;
}

uvec2 window_first()
{
    return window[0];
}

void window_remove_first()
{
    for (int i = 0; i + 1 < CAPACITY; ++i)
        window[i] = window[i + 1];
    window[CAPACITY - 1] = NO_KEY;
}
