/* Claims over sums of points, and over differences: what a paper's averages need. */
#include "claims_kit.h"

/* Method a takes 10, 20, 40; b takes what is told. */
static fm_verdict_kind judge(const char *claim, double b4, double b8, double b16)
{
    const fakes rows = { { { ROW("a", 4, 0.25, 10) },
                           { ROW("a", 8, 0.25, 20) },
                           { ROW("a", 16, 0.25, 40) },
                           { ROW("b", 4, 0.25, b4) },
                           { ROW("b", 8, 0.25, b8) },
                           { ROW("b", 16, 0.25, b16) } } };
    return judge_beside(claim, &rows, NULL).verdict.kind;
}

#define RATIO "of: { method: b }\nover: { method: a }\n"

static void mean_allows_a_point_outside(void **state)
{
    (void)state; /* ratios 0.5, 0.5, 1.3 */
    assert_int_equal(judge("form: mean\nat_most: 0.9\n" RATIO, 5, 10, 52), FM_VERDICT_HOLDS);
    assert_int_equal(judge("form: bound\nat_most: 0.9\n" RATIO, 5, 10, 52), FM_VERDICT_FAILS);
    assert_int_equal(judge("form: mean\nat_most: 0.6\n" RATIO, 5, 10, 52), FM_VERDICT_FAILS);
}

#define SHARE                                                                                      \
    "of: { method: a }\nover: { method: a }\nover_minus: { method: b }\n" /* a / (a - b) is 2 */

static void over_minus_is_taken_from_over(void **state)
{
    (void)state;
    assert_int_equal(judge("form: mean\nat_least: 1.9\nat_most: 2.1\n" SHARE, 5, 10, 20),
                     FM_VERDICT_HOLDS);
    assert_int_equal(judge("form: mean\nat_most: 1.5\n" SHARE, 5, 10, 20), FM_VERDICT_FAILS);
}

/* Two seeds, whose means are 1.9 and 2.1: with one degree of freedom the interval of 2 reaches from
 * 0.7 to 3.3; with nothing between them, hardly beyond 2. */
static fm_verdict judge_seeds(const char *claim, double apart)
{
    const fakes rows = { { { ROW("a", 4, 0.25, 10) },
                           { ROW("b", 4, 0.25, 10 * (2 - apart)) },
                           { ROW("a", 4, 0.25, 10), .seed = 2 },
                           { ROW("b", 4, 0.25, 10 * (2 + apart)), .seed = 2 } } };
    return judge_beside(claim, &rows, NULL).verdict;
}

static void mean_of_seeds_is_as_sure_as_they_agree(void **state)
{
    (void)state;
    const char *claim = "form: mean\nat_least: 1.5\nat_most: 2.5\n" RATIO;
    const fm_verdict apart = judge_seeds(claim, 0.1), close = judge_seeds(claim, 0);
    assert_int_equal(apart.kind, FM_VERDICT_UNCLEAR);
    assert_int_equal(close.kind, FM_VERDICT_HOLDS);
    assert_true(fabs(apart.measured.high - 2 - 12.706 * 0.1) < 0.01);
    assert_true(fabs(apart.measured.median - 2) < 0.01);
}

/* b over a is 1.9 and 2.1, or 2 twice, at k 4 with seeds 1 and 2; 3 at k 8. */
static fm_verdict_kind judge_forms(const char *claim, double apart)
{
    const fakes rows = { { { ROW("a", 4, 0.25, 10) },
                           { ROW("b", 4, 0.25, 10 * (2 - apart)) },
                           { ROW("a", 4, 0.25, 10), .seed = 2 },
                           { ROW("b", 4, 0.25, 10 * (2 + apart)), .seed = 2, .missing = 3 },
                           { ROW("a", 8, 0.25, 10) },
                           { ROW("b", 8, 0.25, 30) },
                           { ROW("a", 8, 0.25, 10), .seed = 2 },
                           { ROW("b", 8, 0.25, 30), .seed = 2 } } };
    return judge_beside(claim, &rows, NULL).verdict.kind;
}

/* Two seeds that are 5 % apart say next to nothing, whatever the form. (A peak
 * compares intervals, as an order does.) */
static void each_form_is_as_sure_as_seeds_agree(void **state)
{
    (void)state;
    static const char *const claims[] = {
        "at_most: 2.5\nof: { method: b, k: 4 }\nover: { method: a }\n",
        "form: any\nat_most: 2.5\n" RATIO,
        "form: order\nof: [{ method: a, k: 4 }, { method: b }]\n",
        "form: monotone\nalong: k\ngoes: rises\ntolerance: 0\n" RATIO,
        "form: crossing\nalong: k\nlevel: 2.6\ngoes: rises\nbetween: [5, 8]\n" RATIO,
        "form: slope\nalong: k\nequals: 0.585\ntolerance: 0.2\n" RATIO,
        "form: spread\nalong: k\nat_most: 1.8\n" RATIO,
    };
    for (size_t i = 0; i < sizeof claims / sizeof claims[0]; i++) {
        if (judge_forms(claims[i], 0.0) != FM_VERDICT_HOLDS)
            fail_msg("seeds agree: %s", claims[i]);
        if (judge_forms(claims[i], 0.1) != FM_VERDICT_UNCLEAR)
            fail_msg("seeds differ: %s", claims[i]);
    }
}

static void what_is_exact_is_so_of_each_seed(void **state)
{
    (void)state;
    assert_int_equal(judge_forms("equals: 0\nof: { method: a, metric: missing }\n", 0),
                     FM_VERDICT_HOLDS);
    assert_int_equal(judge_forms("equals: 0\nof: { method: b, metric: missing }\n", 0),
                     FM_VERDICT_FAILS);
    assert_int_equal(
        judge_forms("at_most: 0\nrequired: true\nof: { method: b, metric: missing }\n", 0),
        FM_VERDICT_FAILS);
    assert_int_equal(judge_forms("at_most: 0\nof: { method: b, metric: missing }\n", 0),
                     FM_VERDICT_UNCLEAR);
}

/* At k 4 seed 1 has no value: that point's row is of seed 2, those of k 8 and 16 are of seed 1. */
static void a_seed_without_a_value_does_not_part_points(void **state)
{
    (void)state;
    const fakes rows = { { { ROW("b", 4, 0.25, 90), .status = "crash" },
                           { ROW("b", 4, 0.25, 90), .seed = 2 },
                           { ROW("b", 8, 0.25, 20) },
                           { ROW("b", 8, 0.25, 20), .seed = 2 },
                           { ROW("b", 16, 0.25, 40) },
                           { ROW("b", 16, 0.25, 40), .seed = 2 },
                           { ROW("a", 4, 0.25, 10) },
                           { ROW("a", 4, 0.25, 10), .seed = 2 } } };
    static const char *const claims[] = {
        "form: monotone\nalong: k\ngoes: rises\nof: { method: b }\n",
        "form: order\nof: [{ method: b }, { method: a }]\n",
    };
    for (size_t i = 0; i < sizeof claims / sizeof claims[0]; i++) {
        const fm_verdict verdict = judge_beside(claims[i], &rows, NULL).verdict;
        if (verdict.kind != FM_VERDICT_FAILS)
            fail_msg("%s: %s", claims[i], verdict.reason);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(mean_allows_a_point_outside),
        cmocka_unit_test(mean_of_seeds_is_as_sure_as_they_agree),
        cmocka_unit_test(over_minus_is_taken_from_over),
        cmocka_unit_test(each_form_is_as_sure_as_seeds_agree),
        cmocka_unit_test(what_is_exact_is_so_of_each_seed),
        cmocka_unit_test(a_seed_without_a_value_does_not_part_points),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
