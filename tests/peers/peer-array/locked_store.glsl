// The authors' spin lock: semaphores in an image, taken by an exchange and freed by a store. The method
// defines is_nearer(), which is asked outside the lock, and insert().
// Invocations of one subgroup may want the same lock, so the section runs inside the branch that took it.
void store(uvec2 pixel, float depth, uint colour)
{
    uvec2 fragment = fm_pack(depth, colour);
    bool is_done = !is_nearer(pixel, fragment.x);
    FM_LOOP for (uint tries = 0u; !is_done && tries < uint(FM_SPIN_MAX); ++tries) {
        if (imageAtomicExchange(fm_image_locks, ivec2(pixel), 1u) == 0u) {
            order_images(); // what the last owner stored is visible from here
            insert(pixel, fragment);
            order_images(); // what this owner stored is visible before the lock is free
            fm_store_locks(pixel, uvec4(0u));
            is_done = true;
        }
    }
    if (!is_done)
        fm_lost(pixel);
}
