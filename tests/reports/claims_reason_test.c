/* A verdict of "unclear" says why, and one without a case which option was not to be had. */
#include "claims_kit.h"

/* b over a is 1, 1 and 1 at k 4, 8 and 16, each within a wide interval. */
static const fakes noisy = { { { ROW("a", 4, 0.25, 10), .noise = 0.2 },
                               { ROW("a", 8, 0.25, 20), .noise = 0.2 },
                               { ROW("a", 16, 0.25, 40), .noise = 0.2 },
                               { ROW("b", 4, 0.25, 10), .noise = 0.2 },
                               { ROW("b", 8, 0.25, 20), .noise = 0.2 },
                               { ROW("b", 16, 0.25, 40), .noise = 0.2 } } };
#define RATIO "of: { method: b }\nover: { method: a }\n"

static const struct undecided {
    const char *claim, *reason;
} undecided[] = {
    { "at_most: 1\ntolerance: 0.05\n" RATIO, "crosses the bound 1.05" },
    { "at_least: 0.9\nat_most: 9\n" RATIO, "crosses the bound 0.9" },
    { "form: mean\nat_most: 1\n" RATIO, "crosses the bound 1" },
    { "form: order\nof: [{ method: a }, { method: b }]\n", "allows both ways" },
    { "form: monotone\nalong: k\ngoes: rises\n" RATIO, "allows both ways" },
    { "form: crossing\nalong: k\nbetween: [8, 16]\n" RATIO, "beyond what is claimed" },
    { "form: peak\nalong: k\nbetween: [8, 8]\n" RATIO, "may be as good" },
    { "form: slope\nalong: k\nequals: 1\nof: { method: b }\n", "crosses the bound 1" },
    { "form: spread\nalong: k\nat_most: 1.01\n" RATIO, "crosses the bound 1.01" },
    { "form: spread\nalong: k\nat_most: 1.5\nof: { method: b }\nminus: { method: a }\n",
      "may be 0" },
};

static void unclear_verdicts_say_why(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof undecided / sizeof undecided[0]; i++) {
        const judged made = judge_beside(undecided[i].claim, &noisy, NULL);
        if (made.verdict.kind != FM_VERDICT_UNCLEAR)
            fail_msg("%s: %s", undecided[i].claim, verdict_name(made.verdict.kind));
        if (strstr(made.verdict.reason, undecided[i].reason) == NULL)
            fail_msg("%s: \"%s\" is not in \"%s\"", undecided[i].claim, undecided[i].reason,
                     made.verdict.reason);
    }
}

/* Each form, on rows that would decide if their launches were more than one. */
static void times_of_one_launch_are_unclear(void **state)
{
    (void)state;
    static const char *const claims[] = {
        "at_most: 9\n" RATIO,
        "form: any\nat_most: 9\n" RATIO,
        "form: mean\nat_most: 9\n" RATIO,
        "form: order\nof: [{ method: a }, { method: b }]\n",
        "form: monotone\nalong: k\ngoes: rises\nof: { method: a }\n",
        "form: crossing\nalong: k\nbetween: [4, 8]\n" RATIO,
        "form: peak\nalong: k\nbetween: [16, 16]\nextreme: greatest\nof: { method: a }\n",
        "form: slope\nalong: k\nequals: 1\nof: { method: a }\n",
        "form: spread\nalong: k\nat_most: 9\nof: { method: a }\n",
        "at_most: 99\nof: { method: a, metric: times_floor }\n",
        "at_least: 1\nof: { method: a, metric: fps }\n",
        "at_least: 1\nof: { method: a, metric: [resolve_ms, frame_ms] }\n",
        "at_most: 9\nof: { method: b }\nminus: { method: a }\n",
    };
    fakes rows = noisy;
    for (int i = 0; i < 6; i++)
        rows.rows[i].launches = 1;
    for (size_t i = 0; i < sizeof claims / sizeof claims[0]; i++) {
        const judged made = judge_beside(claims[i], &rows, NULL);
        if (made.verdict.kind != FM_VERDICT_UNCLEAR ||
            strstr(made.verdict.reason, "launches=3 or more") == NULL)
            fail_msg("%s: %s: %s", claims[i], verdict_name(made.verdict.kind), made.verdict.reason);
        assert_true(isnan(made.verdict.measured.low) && isnan(made.verdict.measured.high));
    }
}

static void counts_and_bytes_need_one_launch_only(void **state)
{
    (void)state;
    const fakes rows = { { { ROW("a", 4, 1, 10), .launches = 1, .bytes = 100, .missing = 3 } } };
    static const char *const claims[] = {
        "equals: 100\nof: { method: a, metric: bytes_allocated }\n",
        "equals: 3\nof: { method: a, metric: missing }\n"
    };
    for (size_t i = 0; i < sizeof claims / sizeof claims[0]; i++)
        assert_int_equal(judge_beside(claims[i], &rows, NULL).verdict.kind, FM_VERDICT_HOLDS);
}

static void decided_verdicts_are_not_called_unclear(void **state)
{
    (void)state;
    const judged made = judge_beside("at_most: 9\n" RATIO, &noisy, NULL);
    assert_int_equal(made.verdict.kind, FM_VERDICT_HOLDS);
    assert_null(strstr(made.verdict.reason, "unclear"));
}

/* KB-SR has an option `samples`, and summary.csv a column. */
static void an_option_goes_before_a_column_of_its_name(void **state)
{
    (void)state;
    const fakes rows = { { { ROW("a", 4, 0.25, 10), .options = "samples=8" },
                           { ROW("a", 4, 0.25, 90), .options = "samples=4" } } };
    const judged made = judge_beside("at_most: 20\nof: { method: a, samples: 8 }\n", &rows, NULL);
    assert_int_equal(made.verdict.kind, FM_VERDICT_HOLDS);
    const judged other = judge_beside("at_most: 20\nof: { method: a, samples: 4 }\n", &rows, NULL);
    assert_int_equal(other.verdict.kind, FM_VERDICT_FAILS);
}

/* Two candidates for the least of `over`, one of which crashed: nothing is missing. */
static void candidates_that_were_not_chosen_are_not_missing(void **state)
{
    (void)state;
    const fakes rows = { { { ROW("a", 4, 0.25, 10) },
                           { ROW("b", 4, 0.25, 20), .options = "lock=spin", .status = "crash" },
                           { ROW("b", 4, 0.25, 40), .options = "lock=interlock" } } };
    const judged made = judge_beside(
        "at_most: 1\nof: { method: a }\nover: { method: b, take: least }\n", &rows, NULL);
    assert_int_equal(made.verdict.kind, FM_VERDICT_HOLDS);
    if (strstr(made.verdict.reason, "left out") != NULL)
        fail_msg("%s", made.verdict.reason);
}

/* A partner of one launch that is not the least takes nothing from the interval. */
static void candidates_that_were_not_chosen_do_not_widen(void **state)
{
    (void)state;
    const fakes rows = { { { ROW("a", 4, 0.25, 10), .device = "hard" },
                           { ROW("b", 4, 0.25, 40), .device = "hard" },
                           { ROW("b", 4, 0.25, 90), .device = "hard", .options = "lock=spin",
                             .launches = 1 } } };
    const judged made = judge_beside(
        "at_most: 1\nof: { method: a }\nover: { method: b, take: least }\n", &rows, NULL);
    assert_int_equal(made.verdict.kind, FM_VERDICT_HOLDS);
    if (strstr(made.verdict.reason, "one launch") != NULL)
        fail_msg("%s", made.verdict.reason);
}

/* One row of `of` without a partner is one row left out, however many candidates failed. */
static void a_point_without_a_partner_is_missing_once(void **state)
{
    (void)state;
    const fakes rows = { { { ROW("a", 4, 0.25, 10) },
                           { ROW("b", 4, 0.25, 20), .options = "lock=spin", .status = "crash" },
                           { ROW("b", 4, 0.25, 40), .options = "lock=hash", .status = "crash" } } };
    const judged made =
        judge_beside("at_most: 1\nof: { method: a }\nover: { method: b }\n", &rows, NULL);
    assert_int_equal(made.verdict.kind, FM_VERDICT_NOT_TESTABLE);
    assert_string_equal(made.verdict.reason, "1 case without a result (B k 4: crash)");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(unclear_verdicts_say_why),
        cmocka_unit_test(times_of_one_launch_are_unclear),
        cmocka_unit_test(counts_and_bytes_need_one_launch_only),
        cmocka_unit_test(decided_verdicts_are_not_called_unclear),
        cmocka_unit_test(an_option_goes_before_a_column_of_its_name),
        cmocka_unit_test(candidates_that_were_not_chosen_are_not_missing),
        cmocka_unit_test(candidates_that_were_not_chosen_do_not_widen),
        cmocka_unit_test(a_point_without_a_partner_is_missing_once),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
