// The exclusive section of a store pass: one invocation at a time for each pixel.
//
// Invocations of one subgroup may want the same lock, so the section runs inside the branch that took
// it and the loop goes on for the others: no lane waits for a lane that cannot move. The loop is
// bounded, and who runs out of tries is counted as lost.
// Whoever takes the lock must see what the last owner stored, and what it stores must be there before
// the lock is free: an acquire and a release, of buffers and, where the pass has them, images.
//   FM_MEMORY_MODEL   the exchange that takes the lock acquires, and what frees it releases
//   FM_LOCK_BARRIERS  without that model, barriers of the owner alone, which order both ways
//   neither           Mesa's software rasterisers, whose memory is coherent: barriers that invocations pass
//                     a different number of times are miscompiled there
#if FM_LOCK_WAITS
// A lock's owner may lose its processor for many milliseconds. The driver counts iterations of loops, so
// waiting that long takes tries that are slow without a loop: 64 atomics, which change nothing. Where lanes
// share one way they cost most of a try that waits for nobody, too.
#define FM_WAIT_ONCE atomicOr(fm_locks[lock], 0u);
#define FM_WAIT_FOUR FM_WAIT_ONCE FM_WAIT_ONCE FM_WAIT_ONCE FM_WAIT_ONCE
#define FM_WAIT_16   FM_WAIT_FOUR FM_WAIT_FOUR FM_WAIT_FOUR FM_WAIT_FOUR
void fm_wait(uint lock)
{
    FM_WAIT_16 FM_WAIT_16 FM_WAIT_16 FM_WAIT_16
}
#endif

#if FM_EXCLUSIVE
bool fm_lock(uint lock)
{
#if FM_MEMORY_MODEL
    return atomicExchange(fm_locks[lock], 1u, gl_ScopeDevice, FM_SHARED_STORAGE,
                          gl_SemanticsAcquire | gl_SemanticsMakeVisible) == 0u;
#else
    bool is_mine = atomicExchange(fm_locks[lock], 1u) == 0u;
    if (is_mine)
        fm_fence();
    return is_mine;
#endif
}

// A store is cheaper than an exchange; by GLSL it is no atomic access, unless the memory model makes it one.
void fm_unlock(uint lock)
{
#if FM_MEMORY_MODEL && FM_LOCK_EXCHANGE
    atomicExchange(fm_locks[lock], 0u, gl_ScopeDevice, FM_SHARED_STORAGE,
                   gl_SemanticsRelease | gl_SemanticsMakeAvailable);
#elif FM_MEMORY_MODEL
    atomicStore(fm_locks[lock], 0u, gl_ScopeDevice, FM_SHARED_STORAGE,
                gl_SemanticsRelease | gl_SemanticsMakeAvailable);
#else
    fm_fence();
#if FM_LOCK_EXCHANGE
    atomicExchange(fm_locks[lock], 0u);
#else
    fm_locks[lock] = 0u;
#endif
#endif
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
        bool is_mine = fm_lock(lock);
        if (is_mine) {
            store(pixel, depth, colour);
            fm_unlock(lock);
            is_done = true;
        }
#if FM_LOCK_WAITS
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
