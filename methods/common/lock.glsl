// The exclusive section of a store pass: one invocation at a time for each pixel.
//
// Invocations of one subgroup may want the same lock, so the section runs inside the branch that took
// it and the loop goes on for the others: no lane waits for a lane that cannot move. The loop is
// bounded, and who runs out of tries is counted as lost.
// FM_LOCK_BARRIERS: where the hardware needs memory barriers they stand outside the branch, which is
// right and fastest on such devices; Mesa's software rasterisers run without (and miscompile
// barriers that invocations pass a different number of times).
#if FM_EXCLUSIVE && FM_LOOP_LIMIT > 0
// A lock's owner may lose its processor for many milliseconds. The driver counts iterations of loops, so
// waiting that long takes tries that are slow without a loop: 64 atomics, which change nothing.
#define FM_WAIT_ONCE atomicOr(fm_locks[lock], 0u);
#define FM_WAIT_FOUR FM_WAIT_ONCE FM_WAIT_ONCE FM_WAIT_ONCE FM_WAIT_ONCE
#define FM_WAIT_16   FM_WAIT_FOUR FM_WAIT_FOUR FM_WAIT_FOUR FM_WAIT_FOUR
void fm_wait(uint lock)
{
    FM_WAIT_16 FM_WAIT_16 FM_WAIT_16 FM_WAIT_16
}
#endif

void fm_take(uvec2 pixel, float depth, uint colour)
{
#if FM_EXCLUSIVE
    if (FM_OWN_CULL != 0 && !wanted(pixel, depth)) {
        fm_culled();
        return;
    }
    uint lock = fm_pixel_index(pixel);
    bool is_done = false;
    FM_LOOP for (uint tries = 0u; !is_done && tries < uint(FM_SPIN_MAX); ++tries) {
        bool is_mine = atomicExchange(fm_locks[lock], 1u) == 0u;
#if FM_LOCK_BARRIERS
        memoryBarrierBuffer(); // what the last owner stored is visible from here
#endif
        if (is_mine)
            store(pixel, depth, colour);
#if FM_LOCK_BARRIERS
        memoryBarrierBuffer(); // what this owner stored is visible before the lock is free
#endif
        if (is_mine) {
#if FM_LOCK_EXCHANGE
            atomicExchange(fm_locks[lock], 0u);
#else
            fm_locks[lock] = 0u; // an exchange costs more, and is not needed where stores stay in order
#endif
            is_done = true;
        }
#if FM_LOOP_LIMIT > 0
        if (!is_mine && tries >= 64u)
            fm_wait(lock);
#endif
    }
    if (is_done)
        fm_locked();
    else
        fm_lost(pixel);
#else
    store(pixel, depth, colour);
#endif
}
