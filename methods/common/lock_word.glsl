// The word that an exclusive pass has for each pixel (its lock_word), as store() sees it.
#define FM_TAKEN 0x80000000u // is set in a lock's word while someone owns the pixel
uint fm_held; // what it held when it was taken; what frees it. Of a failed try: what it holds, with that bit

#if FM_LOCK_IN_WORD
// Who took the lock has the word.
uint fm_lock_word(uvec2 pixel)
{
    return fm_held;
}
void fm_set_lock_word(uvec2 pixel, uint value)
{
    fm_held = value;
}
#elif FM_HAS_LOCK_WORD
uint fm_lock_word(uvec2 pixel)
{
    return fm_load_word(pixel);
}
void fm_set_lock_word(uvec2 pixel, uint value)
{
    fm_store_word(pixel, value);
}
#endif
