// The k nearest so far, in order, in registers. What is farther than all of a full window costs one comparison. There
// are more slots than K: nothing reads what lies beyond, so that compilers drop it.
#include "common/unroll.glsl"
#if K > 32
#define SLOTS      64u
#define EACH(slot) SIXTY_FOUR(slot, 0u)
#elif K > 16
#define SLOTS      32u
#define EACH(slot) THIRTY_TWO(slot, 0u)
#elif K > 8
#define SLOTS      16u
#define EACH(slot) SIXTEEN(slot, 0u)
#else
#define SLOTS      8u
#define EACH(slot) EIGHT(slot, 0u)
#endif
uvec2 nearest[SLOTS];

#define EMPTY_SLOT(i) nearest[i] = uvec2(FM_EMPTY_BITS, 0u);
void select_none()
{
    EACH(EMPTY_SLOT)
}

// Each slot keeps the nearer of two and hands the other one on; the last one's is dropped.
void keep_nearer(inout uvec2 slot, inout uvec2 fragment)
{
    bool is_nearer = fragment.x < slot.x;
    uvec2 other = is_nearer ? slot : fragment;
    slot = is_nearer ? fragment : slot;
    fragment = other;
}
#define KEEP_NEARER(i) keep_nearer(nearest[i], fragment);
void select_nearest(uvec2 fragment)
{
    if (fragment.x < nearest[K - 1].x) {
        EACH(KEEP_NEARER)
    }
}

#define EMIT_SLOT(i)                                                                                                   \
    if (FM_RANK(i, SLOTS) < uint(K) && nearest[FM_RANK(i, SLOTS)].x != FM_EMPTY_BITS)                                  \
        fm_emit(pixel, int(FM_RANK(i, SLOTS)), uintBitsToFloat(nearest[FM_RANK(i, SLOTS)].x),                          \
                nearest[FM_RANK(i, SLOTS)].y);
void emit_selected(uvec2 pixel)
{
    EACH(EMIT_SLOT)
}
