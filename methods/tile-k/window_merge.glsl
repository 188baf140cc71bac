// The window as sorted keys in registers, and a batch of those that came since, sorted and merged when it is
// full, or when what is first has to be known. Networks: K. E. Batcher, Sorting networks and their
// applications, AFIPS 1968.
const int BATCH = 8;
#if CAPACITY <= 8 // more places than asked for are as right
#define PLACES 8
#elif CAPACITY <= 16
#define PLACES 16
#elif CAPACITY <= 32
#define PLACES 32
#else
#define PLACES 64
#endif
uvec2 window[PLACES];
uvec2 batch[BATCH];
int batched;

void window_clear()
{
    for (int i = 0; i < PLACES; ++i)
        window[i] = NO_KEY;
    for (int i = 0; i < BATCH; ++i)
        batch[i] = NO_KEY;
    batched = 0;
}

void order(inout uvec2 a, inout uvec2 b)
{
    bool is_turned = comes_before(b, a);
    uvec2 least = is_turned ? b : a;
    b = is_turned ? a : b;
    a = least;
}

#define ORDER_BATCH(i, j) order(batch[i], batch[j]);
#define ORDER_WINDOW(step)                    \
    for (int i = 0; i < PLACES; ++i)          \
        if ((i & step) == 0)                  \
            order(window[i], window[i | step]);

void sort_batch() // odd-even merge sort
{
    ORDER_BATCH(0, 1) ORDER_BATCH(2, 3) ORDER_BATCH(4, 5) ORDER_BATCH(6, 7)
    ORDER_BATCH(0, 2) ORDER_BATCH(1, 3) ORDER_BATCH(4, 6) ORDER_BATCH(5, 7)
    ORDER_BATCH(1, 2) ORDER_BATCH(5, 6)
    ORDER_BATCH(0, 4) ORDER_BATCH(1, 5) ORDER_BATCH(2, 6) ORDER_BATCH(3, 7)
    ORDER_BATCH(2, 4) ORDER_BATCH(3, 5)
    ORDER_BATCH(1, 2) ORDER_BATCH(3, 4) ORDER_BATCH(5, 6)
}

void sort_window() // that rises, then falls
{
#if PLACES >= 64
    ORDER_WINDOW(32)
#endif
#if PLACES >= 32
    ORDER_WINDOW(16)
#endif
#if PLACES >= 16
    ORDER_WINDOW(8)
#endif
    ORDER_WINDOW(4)
    ORDER_WINDOW(2)
    ORDER_WINDOW(1)
}

// All that came is in its place. Returns the nearest that fell out.
uvec2 window_settle()
{
    uvec2 dropped = NO_KEY;
    if (batched == 0)
        return dropped;
    sort_batch();
    for (int i = 0; i < BATCH; ++i) {
        order(window[PLACES - 1 - i], batch[i]);
        dropped = comes_before(batch[i], dropped) ? batch[i] : dropped;
        batch[i] = NO_KEY;
    }
    sort_window();
    batched = 0;
    return dropped;
}

// Returns the nearest that falls out: NO_KEY while there is room.
uvec2 window_insert(uvec2 key)
{
    for (int i = 0; i < BATCH; ++i)
        batch[i] = i == batched ? key : batch[i];
    ++batched;
    return batched == BATCH ? window_settle() : NO_KEY;
}

uvec2 window_first()
{
    return window[0];
}

void window_remove_first()
{
    for (int i = 0; i + 1 < PLACES; ++i)
        window[i] = window[i + 1];
    window[PLACES - 1] = NO_KEY;
}
