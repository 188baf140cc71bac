// One record, and how many more of it there should be; below 0, how many fewer.
struct damage {
    uvec2 record;
    int weight;
};

// Weights are far from P / 2.
int as_weight(uint w)
{
    return w > P / 2u ? int(w) - int(P) : int(w);
}
// Four numbers are the halves of the record that has this locator: a sum of other records passes for one with a
// chance of 1 in P.
bool is_record(out damage found, uint x, uvec4 y, uint w)
{
    found.record = uvec2(y.x | y.y << 16, y.z | y.w << 16);
    found.weight = as_weight(w);
    return w != 0u && all(lessThan(y, uvec4(0x10000u))) && locator(found.record) == x;
}
uvec4 each_times(uvec4 a, uint b)
{
    return uvec4(times(a.x, b), times(a.y, b), times(a.z, b), times(a.w, b));
}
uvec4 each_minus(uvec4 a, uvec4 b)
{
    return min(a - b, a + P - b);
}

// w code(r): the weight is word 0, and all others follow.
bool decode_one(out damage found, uint s[CODE_WORDS])
{
    uvec4 v = uvec4(s[4], s[5], s[6], s[7]), xv = uvec4(s[8], s[9], s[10], s[11]);
    uint whole = inverse(s[0]), x = times(s[1], whole);
    return is_record(found, x, each_times(v, whole), s[0]) && times(s[2], x) == s[3] && each_times(v, x) == xv;
}

// w1 code(r1) + w2 code(r2). The locators are the roots of x^2 - a x + b, which words 0 to 3 give (Prony); weights and
// halves follow from two equations each.
bool decode_two(out damage one, out damage other, uint s[CODE_WORDS], uint det)
{
    const uint half_of = (P + 1u) / 2u;
    uvec4 v = uvec4(s[4], s[5], s[6], s[7]), xv = uvec4(s[8], s[9], s[10], s[11]);
    uint per_det = inverse(det);
    uint a = times(minus(times(s[1], s[2]), times(s[0], s[3])), per_det);
    uint b = times(minus(times(s[2], s[2]), times(s[1], s[3])), per_det);
    uint square = minus(times(a, a), times(4u, b)), apart = root(square);
    uint x1 = times(plus(a, apart), half_of), x2 = times(minus(a, apart), half_of);
    uint per_apart = inverse(apart);
    uint w1 = times(minus(s[1], times(x2, s[0])), per_apart), w2 = minus(s[0], w1);
    uvec4 u1 = each_times(each_minus(xv, each_times(v, x2)), per_apart), u2 = each_minus(v, u1);
    bool is_first = is_record(one, x1, each_times(u1, inverse(w1)), w1);
    bool is_second = is_record(other, x2, each_times(u2, inverse(w2)), w2);
    return apart != 0u && times(apart, apart) == square && is_first && is_second;
}

// The one or two terms of a sum that is not 0 everywhere. False: there are more, or two records share a locator.
// det is -w1 w2 (x1 - x2)^2 for two.
bool decode(out damage one, out damage other, uint s[CODE_WORDS])
{
    uint det = minus(times(s[1], s[1]), times(s[0], s[2]));
    other = damage(uvec2(0u), 0);
    if (det == 0u)
        return decode_one(one, s);
    return decode_two(one, other, s, det);
}
