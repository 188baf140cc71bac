/* Fragments of one pixel, each with what became of it. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>
#include <stdio.h>
#include <string.h>

#include "base/random.h"
#include "truth/check.h"
#include "truth/states.h"

enum { MOST = 24 };

/* Nearest first; the middle two share a depth. */
static const fm_fragment truth[] = { { 0.25f, 1 }, { 0.5f, 3 }, { 0.5f, 2 }, { 0.75f, 4 } };
enum { TRUTH_COUNT = sizeof truth / sizeof truth[0] };

/* "rank/true rank state" of each line; '-' is none, '<' misordered. */
static void expect(const fm_fragment *captured, uint32_t count, uint32_t wanted, const char *words)
{
    fragment_line lines[MOST];
    uint32_t line_count = 0;
    char text[512] = "", one[64];
    const states_pixel pixel = { captured, count, truth, TRUTH_COUNT, wanted };
    assert_int_equal(states_of_pixel(lines, &line_count, &pixel, NULL), FM_OK);
    for (uint32_t i = 0; i < line_count; i++) {
        char rank[16] = "-", true_rank[16] = "-";
        if (lines[i].rank != STATES_NO_RANK)
            snprintf(rank, sizeof rank, "%u", lines[i].rank);
        if (lines[i].true_rank != STATES_NO_RANK)
            snprintf(true_rank, sizeof true_rank, "%u", lines[i].true_rank);
        snprintf(one, sizeof one, "%s%s/%s %s%s", i > 0 ? ", " : "", rank, true_rank,
                 state_names[lines[i].state], lines[i].is_misordered ? "<" : "");
        strcat(text, one);
    }
    assert_string_equal(text, words);
}

static void what_was_lost_stands_where_it_belongs(void **state)
{
    const fm_fragment captured[] = { { 0.25f, 1 }, { 0.75f, 4 } };
    (void)state;
    expect(captured, 2, UINT32_MAX, "0/0 ok, -/1 missing, -/2 missing, 1/3 ok");
    expect(captured, 2, 3, "0/0 ok, -/1 missing, -/2 missing, 1/3 behind");
    expect(captured, 1, 1, "0/0 ok");
    expect(NULL, 0, 2, "-/0 missing, -/1 missing");
}

static void of_a_tie_either_is_wanted(void **state)
{
    const fm_fragment captured[] = { { 0.25f, 1 }, { 0.5f, 2 } };
    (void)state;
    expect(captured, 2, 2, "0/0 ok, 1/2 ok");
    expect(captured, 2, 3, "0/0 ok, 1/2 ok, -/1 missing");
}

static void what_the_pixel_has_not_is_extra(void **state)
{
    const fm_fragment doubled[] = { { 0.5f, 2 }, { 0.5f, 2 } };
    const fm_fragment coloured[] = { { 0.25f, 9 }, { 0.5f, 3 } };
    (void)state;
    expect(doubled, 2, 2, "-/0 missing, 0/2 ok, 1/- extra");
    expect(coloured, 2, 2, "0/- extra, 1/1 ok"); /* its depth is there, its colour is not */
}

static void the_farthest_beyond_the_count_are_extra(void **state)
{
    const fm_fragment captured[] = { { 0.75f, 4 }, { 0.25f, 1 }, { 0.5f, 3 } };
    (void)state;
    expect(captured, 3, 2, "0/3 extra, 1/0 ok<, 2/1 ok");
}

/* Few depths and colours, so that ties, doubles and strangers come often. */
static uint32_t make_fragments(fm_fragment *fragments, uint64_t *random)
{
    const uint32_t count = random_below(random, MOST / 2);
    for (uint32_t i = 0; i < count; i++)
        fragments[i] = (fm_fragment){ (float)random_below(random, 5) / 4, random_below(random, 3) };
    return count;
}

static void sort_by_depth(fm_fragment *fragments, uint32_t count)
{
    for (uint32_t i = 1; i < count; i++)
        for (uint32_t j = i; j > 0 && fragments[j].depth < fragments[j - 1].depth; j--) {
            const fm_fragment kept = fragments[j];
            fragments[j] = fragments[j - 1];
            fragments[j - 1] = kept;
        }
}

static void states_add_up_to_what_the_check_counts(void **state)
{
    uint64_t random = 17;
    (void)state;
    for (int i = 0; i < 20000; i++) {
        fm_fragment captured[MOST], own[MOST];
        fragment_line lines[2 * MOST];
        fm_check sums = { 0 };
        uint32_t line_count, seen[STATE_COUNT] = { 0 }, misordered = 0;
        const uint32_t count = make_fragments(captured, &random);
        const uint32_t own_count = make_fragments(own, &random);
        const uint32_t wanted = random_below(&random, MOST / 2);
        sort_by_depth(own, own_count);
        const states_pixel pixel = { captured, count, own, own_count, wanted };
        assert_int_equal(states_of_pixel(lines, &line_count, &pixel, NULL), FM_OK);
        for (uint32_t j = 0; j < line_count; j++) {
            seen[lines[j].state]++;
            misordered += lines[j].is_misordered;
        }
        check_pixel(&sums, captured, count, own, own_count,
                    wanted < own_count ? wanted : own_count);
        assert_int_equal(seen[STATE_MISSING], sums.missing);
        assert_int_equal(seen[STATE_EXTRA], sums.extra);
        assert_int_equal(misordered, sums.misordered);
        assert_int_equal(seen[STATE_OK] + seen[STATE_BEHIND] + seen[STATE_EXTRA], count);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_was_lost_stands_where_it_belongs),
        cmocka_unit_test(of_a_tie_either_is_wanted),
        cmocka_unit_test(what_the_pixel_has_not_is_extra),
        cmocka_unit_test(the_farthest_beyond_the_count_are_extra),
        cmocka_unit_test(states_add_up_to_what_the_check_counts),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
