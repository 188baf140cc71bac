// The window as CAPACITY sorted keys that never leave registers: every index is a constant, an insertion
// compares with all of them. For devices that run all lanes through every branch anyway.
uvec2 window[CAPACITY];

void window_clear()
{
    for (int i = 0; i < CAPACITY; ++i)
        window[i] = NO_KEY;
}

// Returns what falls out: NO_KEY while there is room.
uvec2 window_insert(uvec2 key)
{
    for (int i = 0; i < CAPACITY; ++i) {
        bool is_before = comes_before(key, window[i]);
        uvec2 moved = window[i];
        window[i] = is_before ? key : moved;
        key = is_before ? moved : key;
    }
    return key;
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
