// The word of a bounded k+-buffer's pixel. Until it keeps K fragments: NONE_KEPT less how many, beyond all depths,
// so that every fragment is nearer; then the depth bits of the farthest.
const uint NONE_KEPT = 0x7FFFFFFFu;

uint count_in(uint word)
{
    return min(NONE_KEPT - word, uint(K));
}
