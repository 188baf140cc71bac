#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

#include <cmocka.h>

#include "base/random.h"
#include "truth/ties.h"

enum { GROUP_MAX = 6, LIST_MAX = 12, LISTS = 100000 };
static const double rounding = 1e-12; /* of a dozen fragments in double precision */

static uint32_t colour_of(unsigned r, unsigned g, unsigned b, unsigned a)
{
    return r | g << 8 | b << 16 | a << 24;
}

static void assert_near(double value, double expected)
{
    if (!(fabs(value - expected) <= rounding))
        fail_msg("%.17g is not %.17g", value, expected);
}

static fm_ties *made(void)
{
    fm_ties *ties;
    fm_error err;
    if (ties_create(&ties, LIST_MAX, &err) != FM_OK)
        fail_msg("%s", err.message);
    return ties;
}

/* What is walked through: every arrangement of `take` of a group. */
typedef struct enumeration {
    const fm_fragment *group;
    uint32_t count, take;
    fm_range range;
} enumeration;

static void walk(enumeration *all, uint32_t used, uint32_t placed, const double value[4],
                 double through)
{
    for (int c = 0; placed == all->take && c < 4; c++) {
        all->range.low[c] = value[c] < all->range.low[c] ? value[c] : all->range.low[c];
        all->range.high[c] = value[c] > all->range.high[c] ? value[c] : all->range.high[c];
    }
    for (uint32_t i = 0; placed < all->take && i < all->count; i++) {
        double next[4];
        if ((used >> i & 1) != 0)
            continue;
        for (int c = 0; c < 4; c++)
            next[c] = value[c] + through * ((all->group[i].colour >> 8 * c & 255) / 255.0);
        walk(all, used | 1u << i, placed + 1, next,
             through * (1 - (all->group[i].colour >> 24) / 255.0));
    }
}

/* The definition: all orders, and all subsets of a group that straddles the end. */
static fm_range enumerated(const fm_fragment *list, uint32_t count, uint32_t wanted)
{
    fm_range range = { { 0 }, { 0 } };
    double through = 1;
    for (uint32_t first = 0, last; first < count && first < wanted; first = last) {
        for (last = first + 1; last < count && list[last].depth <= list[first].depth;)
            last++;
        enumeration all = { .group = &list[first], .count = last - first };
        all.take = (last < wanted ? last : wanted) - first;
        for (int c = 0; c < 4; c++)
            all.range.low[c] = 1e9;
        walk(&all, 0, 0, (double[4]){ 0 }, 1);
        for (int c = 0; c < 4; c++) {
            range.low[c] += through * all.range.low[c];
            range.high[c] += through * all.range.high[c];
        }
        for (uint32_t i = first; i < last; i++)
            through *= 1 - (list[i].colour >> 24) / 255.0;
    }
    return range;
}

static unsigned any_byte(uint64_t *random)
{
    const uint64_t drawn = random_next(random);
    return drawn % 4 == 0 ? 0 : drawn % 4 == 1 ? 255 : (unsigned)(drawn >> 8 & 255);
}

/* Groups of up to six; in every third one alpha for all. */
static uint32_t random_list(fm_fragment list[LIST_MAX], uint64_t *random)
{
    uint32_t count = 0;
    float depth = 0;
    const bool one_alpha = random_next(random) % 3 == 0;
    unsigned alpha = any_byte(random);
    while (count < LIST_MAX - GROUP_MAX) {
        const uint32_t group = 1 + (uint32_t)(random_next(random) % GROUP_MAX);
        depth += 0.0625f;
        for (uint32_t i = 0; i < group; i++) {
            alpha = one_alpha ? alpha : any_byte(random);
            list[count++] = (fm_fragment){ depth, colour_of(any_byte(random), any_byte(random),
                                                            any_byte(random), alpha) };
        }
    }
    return count;
}

static void range_is_what_all_orders_and_subsets_reach(void **state)
{
    (void)state;
    fm_ties *ties = made();
    uint64_t random = 7;
    for (int i = 0; i < LISTS; i++) {
        fm_fragment list[LIST_MAX];
        fm_range range;
        const uint32_t count = random_list(list, &random);
        const uint32_t wanted = (uint32_t)(random_next(&random) % (count + 2));
        const fm_range expected = enumerated(list, count, wanted);
        ties_range(&range, ties, list, count, wanted);
        for (int c = 0; c < 4; c++) {
            assert_near(range.low[c], expected.low[c]);
            assert_near(range.high[c], expected.high[c]);
        }
    }
    ties_destroy(ties);
}

/* By hand: red and green at one depth, half opaque. Either is in front: 0.5 or 0.25 of each. */
static void range_of_two_tied_fragments(void **state)
{
    (void)state;
    fm_ties *ties = made();
    fm_range range;
    const fm_fragment pair[] = { { 0.5f, colour_of(51, 0, 0, 51) },
                                 { 0.5f, colour_of(0, 51, 0, 51) } };
    ties_range(&range, ties, pair, 2, UINT32_MAX);
    assert_near(range.low[0], 0.16);
    assert_near(range.high[0], 0.2);
    assert_near(range.low[1], 0.16);
    assert_near(range.high[1], 0.2);
    assert_near(range.low[3], 0.36);
    assert_near(range.high[3], 0.36);
    ties_range(&range, ties, pair, 2, 1); /* one of them */
    assert_near(range.low[0], 0);
    assert_near(range.high[0], 0.2);
    assert_near(range.low[3], 0.2);
    ties_destroy(ties);
}

/* The two of the greatest c / a are 0.2 of 0.2 and 0.6 of 0.8; 0.5 of 1 behind the first adds more
 * than the second does. Taking the first two of the sorted group would be wrong. */
static void best_subset_is_not_the_first_of_the_order(void **state)
{
    (void)state;
    fm_ties *ties = made();
    fm_range range;
    const fm_fragment group[] = { { 0.5f, colour_of(51, 0, 0, 51) },
                                  { 0.5f, colour_of(26, 0, 0, 34) },
                                  { 0.5f, colour_of(127, 0, 0, 255) } };
    ties_range(&range, ties, group, 3, 2);
    assert_near(range.high[0], 51 / 255.0 + 0.8 * 127 / 255.0);
    ties_destroy(ties);
}

static void ties_are_open_only_where_colours_differ_among_the_wanted(void **state)
{
    (void)state;
    const uint32_t red = colour_of(255, 0, 0, 255), green = colour_of(0, 255, 0, 255);
    const fm_fragment list[] = { { 0.1f, red }, { 0.1f, red },   { 0.2f, red }, { 0.3f, red },
                                 { 0.3f, red }, { 0.3f, green }, { 0.4f, red }, { 0.4f, green } };
    assert_false(ties_are_open(list, 5, UINT32_MAX));
    assert_false(ties_are_open(list, 8, 3));
    assert_true(ties_are_open(list, 8, 4)); /* the third of the group may take the place */
    assert_true(ties_are_open(list, 8, UINT32_MAX));
    assert_false(ties_are_open(list, 0, 4));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(range_is_what_all_orders_and_subsets_reach),
        cmocka_unit_test(range_of_two_tied_fragments),
        cmocka_unit_test(best_subset_is_not_the_first_of_the_order),
        cmocka_unit_test(ties_are_open_only_where_colours_differ_among_the_wanted),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
