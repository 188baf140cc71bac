// Numbers modulo the prime P, from 0 to P - 1. It is above 2^16, so that halves of words are numbers, and 3 modulo 4,
// so that the power (P + 1) / 4 of a square is its root.
const uint P = 65539u;

// Of any word: 2^16 is -3 modulo P. Not by %, which is many times as many instructions.
uint reduced(uint a)
{
    uint sum = (a & 0xFFFFu) + 3u * P - 3u * (a >> 16); // below 4 P
    sum = min(sum, sum - 2u * P); // what wraps is no minimum
    return min(sum, sum - P);
}
uint plus(uint a, uint b)
{
    return min(a + b, a + b - P);
}
uint minus(uint a, uint b)
{
    return min(a - b, a + P - b);
}
uint modulo(int a)
{
    return a < 0 ? minus(0u, reduced(uint(-a))) : reduced(uint(a));
}
// Of a the smaller of a and -a, so that a product fits into a word.
uint times(uint a, uint b)
{
    uint product = reduced(min(a, P - a) * b);
    return a <= P / 2u ? product : minus(0u, product);
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
