// sums: of each pixel the twelve words of the codes of all that arrived less all that was pushed out, each a sum of
// numbers below P, modulo 2^32; and the complement of the nearest depth that was pushed out, 0 if none was.
// Words are exact as long as what they sum up is below 2^31: 32 000 records that arrived and were not pushed out.
const uint EVICTED = 12u, SUMS = 13u;

uint sum_slot(uvec2 pixel, uint word)
{
    return array_slot(pixel, word, SUMS);
}

// As a signed number: where more is pushed out than came, sums fall below 0.
uint sum_at(uvec2 pixel, uint word)
{
    return modulo(int(sums[sum_slot(pixel, word)]));
}
uint nearest_evicted(uvec2 pixel)
{
    return ~sums[sum_slot(pixel, EVICTED)];
}
