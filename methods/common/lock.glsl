// The exclusive section of a store pass: one invocation at a time for each pixel.
//
// Invocations of one subgroup may want the same lock, so the section runs inside the branch that took
// it and the loop goes on for the others: no lane waits for a lane that cannot move. The loop is
// bounded, and who runs out of tries is counted as lost.
// Whoever takes the lock must see what the last owner stored, and what it stores must be there before
// the lock is free: an acquire and a release, of buffers and, where the pass has them, images.
//   FM_MEMORY_MODEL   the atomic that takes the lock acquires, and what frees it releases
//   FM_LOCK_BARRIERS  without that model, barriers of the owner alone, which order both ways
//   neither           Mesa's software rasterisers, whose memory is coherent: barriers that invocations pass
//                     a different number of times are miscompiled there
#if FM_EXCLUSIVE
// Where a pixel's lock lies: in an image or a buffer of the method (lock_word.glsl), or in the runner's buffer.
#if FM_LOCK_IN_IMAGE
#define FM_LOCK_AT fm_word_image, ivec2(pixel)
#define fm_lock_exchange imageAtomicExchange
#define fm_lock_or imageAtomicOr
#define fm_lock_store imageAtomicStore
#else
#if FM_LOCK_IN_WORD
#define FM_LOCK_AT fm_words[fm_pixel_index(pixel)]
#else
#define FM_LOCK_AT fm_locks[fm_pixel_index(pixel)]
#endif
#define fm_lock_exchange atomicExchange
#define fm_lock_or atomicOr
#define fm_lock_store atomicStore
#endif

#if FM_LOCK_WAITS
// A lock's owner may lose its processor for many milliseconds. The driver counts iterations of loops, so
// waiting that long takes tries that are slow without a loop: 64 atomics, which change nothing. Where lanes
// share one way they cost most of a try that waits for nobody, too.
#define FM_WAIT_ONCE fm_lock_or(FM_LOCK_AT, 0u);
#define FM_WAIT_FOUR FM_WAIT_ONCE FM_WAIT_ONCE FM_WAIT_ONCE FM_WAIT_ONCE
#define FM_WAIT_16   FM_WAIT_FOUR FM_WAIT_FOUR FM_WAIT_FOUR FM_WAIT_FOUR
void fm_wait(uvec2 pixel)
{
    FM_WAIT_16 FM_WAIT_16 FM_WAIT_16 FM_WAIT_16
}
#endif

// Whether this invocation has the lock now. One bit is set: the word's value stays, for others to cull by.
bool fm_lock(uvec2 pixel)
{
#if FM_MEMORY_MODEL
    fm_held = fm_lock_or(FM_LOCK_AT, FM_TAKEN, gl_ScopeDevice, FM_SHARED_STORAGE,
                         gl_SemanticsAcquire | gl_SemanticsMakeVisible);
#else
    fm_held = fm_lock_or(FM_LOCK_AT, FM_TAKEN);
    if (fm_held < FM_TAKEN)
        fm_fence();
#endif
    return fm_held < FM_TAKEN;
}

// Of a failed try, which found the word: whether the fragment is culled by now.
bool fm_is_refused(float depth)
{
#if FM_LOCK_IN_WORD && FM_OWN_CULL
    return !still_wanted(fm_held & ~FM_TAKEN, depth);
#else
    return false;
#endif
}

// A store is cheaper than an exchange; by GLSL it is no atomic access, unless the memory model makes it one.
void fm_unlock(uvec2 pixel)
{
#if FM_MEMORY_MODEL && FM_LOCK_EXCHANGE
    fm_lock_exchange(FM_LOCK_AT, fm_held, gl_ScopeDevice, FM_SHARED_STORAGE,
                     gl_SemanticsRelease | gl_SemanticsMakeAvailable);
#elif FM_MEMORY_MODEL
    fm_lock_store(FM_LOCK_AT, fm_held, gl_ScopeDevice, FM_SHARED_STORAGE,
                  gl_SemanticsRelease | gl_SemanticsMakeAvailable);
#else
    fm_fence();
#if FM_LOCK_EXCHANGE
    fm_lock_exchange(FM_LOCK_AT, fm_held);
#elif FM_LOCK_IN_IMAGE
    fm_store_word(pixel, fm_held);
#else
    FM_LOCK_AT = fm_held;
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
    bool is_done = false, is_refused = false;
    FM_LOOP for (uint tries = 0u; !is_done && !is_refused && tries < uint(FM_SPIN_MAX); ++tries) {
        bool is_mine = fm_lock(pixel);
        if (is_mine) {
            store(pixel, depth, colour);
            fm_unlock(pixel);
            is_done = true;
        }
        is_refused = !is_done && fm_is_refused(depth);
#if FM_LOCK_WAITS
        if (!is_mine && tries >= 64u)
            fm_wait(pixel);
#endif
    }
    if (is_done)
        fm_locked();
    else if (is_refused)
        fm_culled();
    else
        fm_lost(pixel);
#else
    store(pixel, depth, colour);
#endif
}
