/* Benjamini and Hochberg's adjustment against print and against its definition; split levels. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>

#include "base/random.h"
#include "decide/levels.h"

/* Fifteen outcomes after a heart attack (Benjamini and Hochberg 1995, section 3.2): of these the
 * first four count at 5 %, and the fifth would at 0.0603. */
static void adjustment_of_the_paper_rejects_four_of_fifteen(void **state)
{
    const double p[15] = { 0.0001, 0.0004, 0.0019, 0.0095, 0.0201, 0.0278, 0.0298, 0.0344,
                           0.0459, 0.3240, 0.4262, 0.5719, 0.6528, 0.7590, 1.0000 };
    double adjusted[15];
    (void)state;
    assert_int_equal(levels_adjust(adjusted, p, 15, NULL), FM_OK);
    for (int i = 0; i < 15; i++)
        assert_true((adjusted[i] <= 0.05) == (i < 4));
    assert_true(fabs(adjusted[3] - 0.0095 * 15 / 4) < 1e-12);
    assert_true(fabs(adjusted[4] - 0.0201 * 15 / 5) < 1e-12);
    assert_true(fabs(adjusted[5] - 0.0298 * 15 / 7) < 1e-12); /* that of the seventh is less */
    assert_true(adjusted[14] == 1.0);
}

/* The least of count * q / (number up to q), over all q from p on. */
static double slow_adjusted(const double *p, size_t count, double of)
{
    double least = 1.0;
    for (size_t i = 0; i < count; i++) {
        size_t up_to = 0;
        for (size_t j = 0; j < count; j++)
            up_to += p[j] <= p[i];
        if (p[i] >= of)
            least = fmin(least, (double)count * p[i] / (double)up_to);
    }
    return least;
}

static void adjustment_equals_its_definition_with_ties(void **state)
{
    uint64_t seed = 11;
    (void)state;
    for (size_t count = 1; count <= 60; count++) {
        double p[60], adjusted[60];
        for (size_t i = 0; i < count; i++)
            p[i] = random_below(&seed, count % 2 ? 21 : 1000001) / (count % 2 ? 20.0 : 1e6);
        assert_int_equal(levels_adjust(adjusted, p, count, NULL), FM_OK);
        for (size_t i = 0; i < count; i++)
            assert_true(fabs(adjusted[i] - slow_adjusted(p, count, p[i])) < 1e-12);
        assert_int_equal(levels_adjust(p, p, count, NULL), FM_OK); /* in place */
        assert_memory_equal(p, adjusted, count * sizeof *p);
    }
}

static void adjustment_refuses_what_is_no_p_value(void **state)
{
    const double above[] = { 0.1, 1.5 }, none[] = { NAN };
    double adjusted[2];
    fm_error err = { 0 };
    (void)state;
    assert_int_equal(levels_adjust(adjusted, above, 2, &err), FM_INVALID);
    assert_string_equal(err.message, "p-value 1 is 1.5: not from 0 to 1");
    assert_int_equal(levels_adjust(adjusted, none, 1, &err), FM_INVALID);
    assert_int_equal(levels_adjust(adjusted, NULL, 0, &err), FM_OK);
}

static void levels_of_looks_are_their_shares_of_the_data(void **state)
{
    const uint32_t pairs[] = { 20, 40 }, launches[] = { 5, 10, 20, 40 };
    double levels[4];
    (void)state;
    assert_int_equal(levels_split(levels, pairs, 2, 0.05, NULL), FM_OK);
    assert_true(levels[0] == 0.025 && levels[1] == 0.025);
    assert_int_equal(levels_split(levels, launches, 4, 0.08, NULL), FM_OK);
    assert_true(fabs(levels[0] - 0.01) < 1e-15 && fabs(levels[1] - 0.01) < 1e-15);
    assert_true(fabs(levels[2] - 0.02) < 1e-15 && fabs(levels[3] - 0.04) < 1e-15);
}

static void levels_refuse_looks_that_do_not_rise(void **state)
{
    const uint32_t still[] = { 20, 20 }, none[] = { 0, 5 };
    double levels[2];
    (void)state;
    assert_int_equal(levels_split(levels, still, 2, 0.05, NULL), FM_INVALID);
    assert_int_equal(levels_split(levels, none, 2, 0.05, NULL), FM_INVALID);
    assert_int_equal(levels_split(levels, still, 0, 0.05, NULL), FM_INVALID);
    assert_int_equal(levels_split(levels, still, 1, 1.0, NULL), FM_INVALID);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(adjustment_of_the_paper_rejects_four_of_fifteen),
        cmocka_unit_test(adjustment_equals_its_definition_with_ties),
        cmocka_unit_test(adjustment_refuses_what_is_no_p_value),
        cmocka_unit_test(levels_of_looks_are_their_shares_of_the_data),
        cmocka_unit_test(levels_refuse_looks_that_do_not_rise),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
