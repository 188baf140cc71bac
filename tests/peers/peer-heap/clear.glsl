void clear(uvec2 pixel)
{
    fm_store_counters(pixel, uvec4(0u));
    fm_store_locks(pixel, uvec4(0u));
}
