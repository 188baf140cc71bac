/* The signed-rank test against tables, and against all signs written out. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>

#include "base/random.h"
#include "decide/signed_rank.h"

/* Hamilton's depression scale of nine patients, before and after (Hollander and Wolfe 1973, table
 * 3.1). */
static const double depression[] = { 1.83 - 0.878, 0.50 - 0.647, 1.62 - 0.598,
                                     2.48 - 2.05,  1.68 - 1.06,  1.88 - 1.29,
                                     1.55 - 1.06,  3.06 - 3.14,  1.30 - 1.29 };

static void test_gives_the_published_p_of_nine_patients(void **state)
{
    fm_signed_rank test;
    (void)state;
    assert_int_equal(signed_rank_test(&test, depression, 9, NULL), FM_OK);
    assert_true(test.sum == 40.0);
    assert_true(fabs(test.p_greater - 10.0 / 512.0) < 1e-12); /* 0.0195 */
    assert_true(fabs(test.p_two_sided - 20.0 / 512.0) < 1e-12);
    assert_true(fabs(test.p_less - 505.0 / 512.0) < 1e-12);
}

/* Two-sided, 5 %: the table that textbooks print. */
static void quantiles_are_those_of_the_published_table(void **state)
{
    static const uint32_t table[][2] = {
        { 6, 0 },    { 7, 2 },    { 8, 3 },    { 9, 5 },    { 10, 8 },  { 11, 10 }, { 12, 13 },
        { 13, 17 },  { 14, 21 },  { 15, 25 },  { 16, 29 },  { 17, 34 }, { 18, 40 }, { 19, 46 },
        { 20, 52 },  { 21, 58 },  { 22, 65 },  { 23, 73 },  { 24, 81 }, { 25, 89 }, { 30, 137 },
        { 35, 195 }, { 40, 264 }, { 45, 343 }, { 50, 434 },
    };
    size_t c;
    double chance;
    (void)state;
    for (size_t i = 0; i < sizeof table / sizeof table[0]; i++) {
        assert_true(signed_rank_quantile(&c, &chance, table[i][0], 0.025));
        assert_int_equal(c, table[i][1]);
    }
    assert_true(signed_rank_quantile(&c, &chance, 10, 0.025));
    assert_true(fabs(chance - 25.0 / 1024.0) < 1e-12);
    assert_false(signed_rank_quantile(&c, &chance, 5, 0.025)); /* 1 / 32 is more */
    assert_true(chance == 0.0);
}

/* Twice the rank of |values[i]|, by counting. */
static int slow_rank(const double *values, int count, int i)
{
    int rank = 1;
    for (int j = 0; j < count; j++)
        rank += 2 * (fabs(values[j]) < fabs(values[i])) + (fabs(values[j]) == fabs(values[i]));
    return rank;
}

/* All signs of those that are not 0, one after the other. */
static void expect_all_signs(const double *values, int count)
{
    int ranks[16], n = 0, sum = 0;
    uint32_t above = 0, below = 0;
    fm_signed_rank test;
    for (int i = 0; i < count; i++) {
        if (values[i] == 0.0)
            continue;
        ranks[n] = slow_rank(values, count, i);
        sum += values[i] > 0.0 ? ranks[n] : 0;
        n++;
    }
    for (uint32_t signs = 0; signs < UINT32_C(1) << n; signs++) {
        int other = 0;
        for (int i = 0; i < n; i++)
            other += signs >> i & 1 ? ranks[i] : 0;
        above += other >= sum;
        below += other <= sum;
    }
    assert_int_equal(signed_rank_test(&test, values, (size_t)count, NULL), FM_OK);
    assert_int_equal(test.count, n);
    assert_true(2.0 * test.sum == sum);
    assert_true(fabs(test.p_greater - ldexp(above, -n)) < 1e-12);
    assert_true(fabs(test.p_less - ldexp(below, -n)) < 1e-12);
    assert_true(fabs(test.p_two_sided - fmin(1.0, ldexp(fmin(above, below), 1 - n))) < 1e-12);
}

/* Values of -3 to 3: ties and zeros; of -3000 to 3000: hardly any. */
static void test_equals_the_enumeration_of_all_signs(void **state)
{
    uint64_t seed = 1;
    (void)state;
    for (int round = 0; round < 400; round++) {
        double values[14];
        const int count = 1 + round % 14, most = round % 3 == 0 ? 3000 : 3;
        for (int i = 0; i < count; i++)
            values[i] = (double)random_below(&seed, (uint32_t)(2 * most + 1)) - most;
        expect_all_signs(values, count);
    }
}

static void test_of_zeros_rejects_nothing(void **state)
{
    const double zeros[3] = { 0.0, -0.0, 0.0 };
    fm_signed_rank test;
    (void)state;
    assert_int_equal(signed_rank_test(&test, zeros, 3, NULL), FM_OK);
    assert_true(test.count == 0 && test.p_greater == 1.0 && test.p_less == 1.0);
    assert_true(test.p_two_sided == 1.0);
}

/* Pratt's own example. With the zero dropped, p of the first would be 70 / 4096 = 0.0171, so that
 * lowering all by 1 made "above 0" more certain. */
static void test_is_no_surer_of_lower_differences(void **state)
{
    const double before[13] = { 0, 2, 3, 4, 6, 7, 8, 9, 11, 14, 15, 17, -18 };
    double after[13];
    fm_signed_rank of, lowered;
    (void)state;
    for (int i = 0; i < 13; i++)
        after[i] = before[i] - 1.0;
    assert_int_equal(signed_rank_test(&of, before, 13, NULL), FM_OK);
    assert_int_equal(signed_rank_test(&lowered, after, 13, NULL), FM_OK);
    assert_true(fabs(of.p_greater - 49.0 / 4096.0) < 1e-12);
    assert_true(fabs(lowered.p_greater - 115.0 / 8192.0) < 1e-12);
}

/* The rarest sum of a thousand keeps its digits: 2^-1000. */
static void test_takes_a_thousand_differences(void **state)
{
    static double values[DECIDE_VALUES];
    fm_signed_rank test;
    (void)state;
    for (int i = 0; i < DECIDE_VALUES; i++)
        values[i] = 1.0 + i;
    assert_int_equal(signed_rank_test(&test, values, DECIDE_VALUES, NULL), FM_OK);
    assert_true(fabs(test.p_greater / ldexp(1.0, -DECIDE_VALUES) - 1.0) < 1e-12);
    assert_true(fabs(test.p_less - 1.0) < 1e-12);
}

static void test_refuses_what_it_cannot_rank(void **state)
{
    static double many[DECIDE_VALUES + 1];
    const double odd[] = { 1.0, NAN }, endless[] = { INFINITY };
    fm_signed_rank test;
    fm_error err = { 0 };
    (void)state;
    assert_int_equal(signed_rank_test(&test, odd, 0, &err), FM_INVALID);
    assert_int_equal(signed_rank_test(&test, odd, 2, &err), FM_INVALID);
    assert_string_equal(err.message, "value 1 is nan: no finite number");
    assert_int_equal(signed_rank_test(&test, endless, 1, &err), FM_INVALID);
    assert_int_equal(signed_rank_test(&test, many, DECIDE_VALUES + 1, &err), FM_INVALID);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_gives_the_published_p_of_nine_patients),
        cmocka_unit_test(quantiles_are_those_of_the_published_table),
        cmocka_unit_test(test_equals_the_enumeration_of_all_signs),
        cmocka_unit_test(test_of_zeros_rejects_nothing),
        cmocka_unit_test(test_is_no_surer_of_lower_differences),
        cmocka_unit_test(test_takes_a_thousand_differences),
        cmocka_unit_test(test_refuses_what_it_cannot_rank),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
