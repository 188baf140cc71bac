/* Words of what became of a case. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "model/outcome.h"

static void each_status_has_a_word_of_its_own(void **state)
{
    (void)state;
    for (int i = 0; i < FM_CASE_STATUS_COUNT; i++) {
        fm_case_status status = FM_CASE_STATUS_COUNT;
        assert_true(case_status_parse(&status, case_status_name((fm_case_status)i)));
        assert_int_equal(status, i);
    }
}

static void each_reason_has_a_word_of_its_own(void **state)
{
    (void)state;
    assert_string_equal(case_reason_name(FM_REASON_NONE), "");
    for (int i = 0; i < FM_REASON_COUNT; i++) {
        fm_reason reason = FM_REASON_COUNT;
        assert_true(case_reason_parse(&reason, case_reason_name((fm_reason)i), NULL));
        assert_int_equal(reason, i);
    }
}

static void an_unknown_reason_has_the_nearest_beside_it(void **state)
{
    (void)state;
    fm_reason reason = FM_REASON_LOOPS;
    const char *nearest = "";
    assert_false(case_reason_parse(&reason, "device-limits", &nearest));
    assert_string_equal(nearest, "device-limit");
    assert_false(case_reason_parse(&reason, "something else", &nearest));
    assert_null(nearest);
    assert_false(case_reason_parse(&reason, NULL, NULL));
    assert_int_equal(reason, FM_REASON_LOOPS);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_status_has_a_word_of_its_own),
        cmocka_unit_test(each_reason_has_a_word_of_its_own),
        cmocka_unit_test(an_unknown_reason_has_the_nearest_beside_it),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
