// Numbers modulo the prime P, from 0 to P - 1. It is above 2^16, so that halves of words are numbers, and 3 modulo 4,
// so that the power (P + 1) / 4 of a square is its root.
const uint P = 65539u;

uint modulo(int a)
{
    return a < 0 ? (P - uint(-a) % P) % P : uint(a) % P;
}
uint plus(uint a, uint b)
{
    return (a + b) % P;
}
uint minus(uint a, uint b)
{
    return (a + P - b) % P;
}
// No step is above 2^25.
uint times(uint a, uint b)
{
    return (a * (b >> 8) % P * 256u + a * (b & 255u)) % P;
}
uint power(uint a, uint exponent)
{
    uint product = 1u;
    FM_LOOP for (; exponent > 0u; exponent >>= 1) {
        if ((exponent & 1u) != 0u)
            product = times(product, a);
        a = times(a, a);
    }
    return product;
}
// Fermat: of a that is not 0.
uint inverse(uint a)
{
    return power(a, P - 2u);
}
// A root of a, if it has one: the caller squares it.
uint root(uint a)
{
    return power(a, (P + 1u) / 4u);
}
