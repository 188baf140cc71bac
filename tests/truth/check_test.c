/* Fragments of one pixel against truth. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include "truth/check.h"

/* Nearest first; the middle two share a depth. */
static const fm_fragment truth[] = { { 0.25f, 1 }, { 0.5f, 3 }, { 0.5f, 2 }, { 0.75f, 4 } };
enum { TRUTH_COUNT = sizeof truth / sizeof truth[0] };

static fm_check check_one(fm_fragment *captured, uint32_t count, uint32_t wanted)
{
    fm_check check = { 0 };
    check_pixel(&check, captured, count, truth, TRUTH_COUNT, wanted);
    return check;
}

static void the_wanted_fragments_are_right_whichever_of_a_tie(void **state)
{
    (void)state;
    fm_fragment captured[] = { { 0.25f, 1 }, { 0.5f, 2 } };
    const fm_check check = check_one(captured, 2, 2);
    assert_int_equal(check.missing + check.extra + check.misordered, 0);
    assert_int_equal(check.wrong_pixels, 0);
}

static void a_lost_fragment_is_missing(void **state)
{
    (void)state;
    fm_fragment captured[] = { { 0.25f, 1 }, { 0.75f, 4 } };
    const fm_check check = check_one(captured, 2, 3);
    assert_int_equal(check.missing, 2);
    assert_int_equal(check.extra, 0);
    assert_int_equal(check.wrong_pixels, 1);
}

static void a_doubled_fragment_is_extra(void **state)
{
    (void)state;
    fm_fragment captured[] = { { 0.5f, 2 }, { 0.5f, 2 } };
    const fm_check check = check_one(captured, 2, 2);
    assert_int_equal(check.missing, 1);
    assert_int_equal(check.extra, 1);
}

static void a_fragment_beyond_the_wanted_is_extra(void **state)
{
    (void)state;
    fm_fragment captured[] = { { 0.25f, 1 }, { 0.5f, 3 }, { 0.5f, 2 }, { 0.75f, 4 } };
    const fm_check check = check_one(captured, 4, 3);
    assert_int_equal(check.missing, 0);
    assert_int_equal(check.extra, 1);
    assert_int_equal(check.wrong_pixels, 1);
}

static void neighbours_in_decreasing_depth_are_misordered(void **state)
{
    (void)state;
    fm_fragment captured[] = { { 0.5f, 2 }, { 0.25f, 1 }, { 0.5f, 3 } };
    const fm_check check = check_one(captured, 3, 3);
    assert_int_equal(check.misordered, 1);
    assert_int_equal(check.missing + check.extra, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_wanted_fragments_are_right_whichever_of_a_tie),
        cmocka_unit_test(a_lost_fragment_is_missing),
        cmocka_unit_test(a_doubled_fragment_is_extra),
        cmocka_unit_test(a_fragment_beyond_the_wanted_is_extra),
        cmocka_unit_test(neighbours_in_decreasing_depth_are_misordered),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
