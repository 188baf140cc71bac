// What every shader of every method sees. The runner puts the parameters (K, N, FM_WIDTH, ...) and
// the declarations of the resources before this file, and the feed's main() after the method's own.

uint fm_pixel_index(uvec2 pixel)
{
    return pixel.y * uint(FM_WIDTH) + pixel.x;
}

// Bits of the depth that methods see of a rasterised one: the same or, of a reversed projection (1 near, 0 far),
// what grows from near to far and keeps all floats apart. runner/scene/hand_on.h has the reasons.
uint fm_hand_on_bits(uint bits)
{
#if FM_DEPTH_REVERSED
    bits = bits >= 0x3F800000u ? 0u : bits < 0x00800000u ? 0x3F800000u : 0x3FFFFFFFu - bits;
#endif
    return bits;
}
float fm_hand_on(float depth)
{
#if FM_DEPTH_REVERSED
    depth = uintBitsToFloat(fm_hand_on_bits(floatBitsToUint(depth) & 0x7FFFFFFFu)); // -0 is 0
#endif
    return depth;
}

// A fragment as most methods keep it: 8 bytes. Bits of a depth >= 0 compare as the depth does.
uvec2 fm_pack(float depth, uint colour)
{
    return uvec2(floatBitsToUint(abs(depth)), colour);
}
const uint FM_EMPTY_BITS = 0x7F800000u; // +infinity: farther than any fragment, 1.0 included

// What invocations share, for the memory model.
#define FM_SHARED_STORAGE (gl_StorageSemanticsBuffer | gl_StorageSemanticsImage)

// Orders accesses of this invocation to buffers and images as others see them, where the hardware needs it.
void fm_fence()
{
#if FM_MEMORY_MODEL
    memoryBarrier(gl_ScopeDevice, FM_SHARED_STORAGE,
                  gl_SemanticsAcquireRelease | gl_SemanticsMakeAvailable | gl_SemanticsMakeVisible);
#elif FM_LOCK_BARRIERS
    memoryBarrierBuffer();
#if FM_IMAGES
    memoryBarrierImage();
#endif
#endif
}

// Fragments that found no room. In a helper invocation atomics do nothing, so none is counted there.
void fm_lost(uvec2 pixel)
{
    atomicAdd(fm_counters[FM_COUNTER_LOST], 1u);
}

// Of a pass that resumes: there is more to do, in another run.
void fm_go_on()
{
#if FM_RESUMES
    atomicAdd(fm_counters[FM_COUNTER_GO_ON], 1u); // a sum
#endif
}

// The device's limit of loop iterations is reached, or would be: what this pass left out is not the method's
// fault, and the runner refuses the case.
void fm_cut()
{
#if FM_LOOP_LIMIT
    atomicOr(fm_counters[FM_COUNTER_CUT], uint(FM_PASS_BIT)); // bits only come
#endif
}

// At the end of every shader. Where a device ends all loops of an invocation after FM_LOOP_LIMIT
// iterations, what they were to do is not done, and no loop goes on after that: one that should turn
// twice and does not tells it, and the runner refuses the case. Invocations of a vector share the limit.
void fm_tell_cut()
{
#if FM_TELLS_CUT
    uint turns = 0u;
    FM_LOOP do {
        ++turns;
    } while (turns < fm_two);
    if (turns < fm_two)
        fm_cut();
#endif
}

#ifdef FM_CAPTURE
// Events are counted in the checked build only: the timed one is undisturbed. What arrived, and was culled of
// that, is counted in loops the first time only: the scene comes anew each time.
void fm_culled()
{
    if (fm_iteration == 0u)
        atomicAdd(fm_counters[FM_COUNTER_CULLED], 1u);
}
void fm_locked()
{
    atomicAdd(fm_counters[FM_COUNTER_LOCKED], 1u);
}
// Pixels whose damage by racing fragments a method found, and repaired or could not repair.
void fm_repaired()
{
    atomicAdd(fm_counters[FM_COUNTER_REPAIRED], 1u);
}
void fm_unrepaired()
{
    atomicAdd(fm_counters[FM_COUNTER_UNREPAIRED], 1u);
}
void fm_arrived()
{
    if (FM_IS_STORE != 0 && fm_iteration == 0u)
        atomicAdd(fm_counters[FM_COUNTER_ARRIVED], 1u);
}
#else
void fm_culled()
{
}
void fm_locked()
{
}
void fm_repaired()
{
}
void fm_unrepaired()
{
}
void fm_arrived()
{
}
#endif
