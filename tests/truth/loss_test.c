/* What traits excuse of the missing fragments of a pixel, and nothing more. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

#include "truth/check.h"

enum {
    ONE = FM_TRAIT_LOSES_DEPTH_ONE,
    TIES = FM_TRAIT_LOSES_TIES,
    PASSES = FM_TRAIT_PASSES_LOSE_TIES,
    MOST = 6
};

/* A pixel's depths, front to back, ended by -1; colours follow their places. */
typedef struct pixel {
    const char *what;
    float truth[MOST], captured[MOST];
    uint32_t traits, missing, at_depth_one, of_ties;
} pixel;

static const pixel pixels[] = {
    { "nothing is missing", { 0.5f, 1, -1 }, { 0.5f, 1, -1 }, ONE | TIES, 0, 0, 0 },
    { "depth 1, declared", { 0.5f, 1, -1 }, { 0.5f, -1 }, ONE, 1, 1, 0 },
    { "depth 1, not declared", { 0.5f, 1, -1 }, { 0.5f, -1 }, 0, 1, 0, 0 },
    { "depth 1, ties declared", { 0.5f, 1, -1 }, { 0.5f, -1 }, TIES, 1, 0, 0 },
    { "all of three at depth 1", { 1, 1, 1, -1 }, { -1 }, ONE, 3, 3, 0 },
    { "nearer than depth 1", { 0.5f, 1, -1 }, { 1, -1 }, ONE, 1, 0, 0 },
    { "the depth before 1", { 0x1.fffffep-1f, -1 }, { -1 }, ONE, 1, 0, 0 },
    { "another beside depth 1", { 0.25f, 0.5f, 1, -1 }, { 0.25f, -1 }, ONE, 2, 1, 0 },
    { "two of three equal depths", { 0.5f, 0.5f, 0.5f, -1 }, { 0.5f, -1 }, TIES, 2, 0, 2 },
    { "all of three equal depths", { 0.5f, 0.5f, 0.5f, -1 }, { -1 }, TIES, 3, 0, 2 },
    { "equal depths, not declared", { 0.5f, 0.5f, -1 }, { 0.5f, -1 }, ONE, 1, 0, 0 },
    { "a depth of its own", { 0.25f, 0.5f, 0.5f, -1 }, { 0.5f, -1 }, TIES, 2, 0, 1 },
    { "ties at depth 1, both declared", { 1, 1, -1 }, { 1, -1 }, ONE | TIES, 1, 1, 0 },
    { "ties at depth 1, ties declared", { 1, 1, -1 }, { -1 }, TIES, 2, 0, 1 },
    { "ties that passes lose", { 0.5f, 0.5f, 0.5f, -1 }, { 0.5f, 0.5f, -1 }, PASSES, 1, 0, 1 },
    { "-0 and 0", { -0.0f, 0, -1 }, { 0, -1 }, TIES, 1, 0, 1 },
    { "depths that are no numbers excuse nothing", { 0.5f, -1 }, { NAN, -1 }, ONE | TIES, 1, 0, 0 },
};

static uint32_t fragments_of(fm_fragment fragments[MOST], const float depths[MOST])
{
    uint32_t count = 0;
    while (count < MOST && !(depths[count] < 0)) {
        fragments[count] = (fm_fragment){ .depth = depths[count], .colour = count };
        count++;
    }
    return count;
}

static void traits_excuse_what_they_declare_and_no_more(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof pixels / sizeof pixels[0]; i++) {
        const pixel *row = &pixels[i];
        fm_fragment truth[MOST], captured[MOST];
        fm_check check = { .traits = row->traits };
        const uint32_t wanted = fragments_of(truth, row->truth);
        const uint32_t count = fragments_of(captured, row->captured);
        check_pixel(&check, captured, count, truth, wanted, wanted);
        if (check.missing != row->missing || check.excused.at_depth_one != row->at_depth_one ||
            check.excused.of_ties != row->of_ties)
            fail_msg("%s: missing %u, at depth 1 %u, of ties %u", row->what,
                     (unsigned)check.missing, (unsigned)check.excused.at_depth_one,
                     (unsigned)check.excused.of_ties);
    }
}

/* Known from truth alone, whatever was captured. */
static void what_is_to_get_lost_is_counted(void **state)
{
    (void)state;
    const fm_fragment truth[] = { { 0.25f, 1 }, { 0.5f, 2 }, { 0.5f, 3 },
                                  { 0.5f, 4 },  { 1, 5 },    { 1, 6 } };
    fm_fragment captured[MOST];
    fm_check check = { .traits = ONE | TIES };
    memcpy(captured, truth, sizeof truth);
    check_pixel(&check, captured, MOST, truth, MOST, MOST);
    assert_int_equal(check.wanted, MOST);
    assert_int_equal(check.declared.of_ties, 2);
    assert_int_equal(check.declared.at_depth_one, 2);
    assert_int_equal(check.excused.of_ties + check.excused.at_depth_one, 0);
    check_pixel(&check, captured, 1, truth, MOST, 3); /* of three wanted ones, one tie */
    assert_int_equal(check.wanted, MOST + 3);
    assert_int_equal(check.declared.of_ties, 3);
    check = (fm_check){ .traits = TIES };
    check_pixel(&check, captured, 0, truth, MOST, MOST);
    assert_int_equal(check.declared.of_ties, 3); /* with the two at depth 1 */
}

/* Only what was wanted can be missing. */
static void fragments_beyond_the_wanted_are_not_lost(void **state)
{
    (void)state;
    const fm_fragment truth[] = { { 0.5f, 1 }, { 1, 2 }, { 1, 3 } };
    fm_fragment captured[] = { { 0.5f, 1 } };
    fm_check check = { .traits = ONE };
    check_pixel(&check, captured, 1, truth, 3, 1);
    assert_int_equal(check.excused.at_depth_one, 0);
    check_pixel(&check, captured, 1, truth, 3, 2);
    assert_int_equal(check.excused.at_depth_one, 1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(traits_excuse_what_they_declare_and_no_more),
        cmocka_unit_test(what_is_to_get_lost_is_counted),
        cmocka_unit_test(fragments_beyond_the_wanted_are_not_lost),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
