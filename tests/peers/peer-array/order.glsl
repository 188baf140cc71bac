// Orders this invocation's accesses to images as others see them. The published code has none of these, and
// can lose fragments.
void order_images()
{
#if FM_LOCK_BARRIERS
    memoryBarrierImage();
#endif
}
