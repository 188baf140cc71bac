/* Plans in parts: whole, together, balanced, and the same on each machine. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "plan/cost.h"
#include "plan/shard.h"

enum { SCENES = 10, METHODS = 3, CASES = SCENES * METHODS * 2 };
static const char *const method_ids[METHODS] = { "ab-array", "exact", "kb" };

/* Scenes of one to SCENES layers, two feeds, three methods. */
static fm_plan make_plan(void)
{
    fm_plan plan = { .cases = calloc(CASES, sizeof(fm_case)), .launches = 2, .frames = 3 };
    assert_non_null(plan.cases);
    for (size_t i = 0; i < CASES; i++) {
        fm_case *made = &plan.cases[plan.count++];
        snprintf(made->id, sizeof made->id, "%016zx", i);
        snprintf(made->method, sizeof made->method, "%s", method_ids[i % METHODS]);
        snprintf(made->scene, sizeof made->scene, "layers");
        snprintf(made->device, sizeof made->device, "dummy");
        snprintf(made->feed, sizeof made->feed, "%s", i < CASES / 2 ? "raster" : "compute-layer");
        settings_default(&made->settings);
        made->settings.n = (uint32_t)(1 + i / METHODS % SCENES);
    }
    return plan;
}

static fm_plan make_shard(uint32_t index, uint32_t count, const char *reference)
{
    fm_plan plan = make_plan();
    const fm_shard_desc desc = { .index = index, .count = count, .reference = reference };
    fm_error err = { 0 };
    assert_int_equal(plan_shard(&plan, &desc, &err), FM_OK);
    return plan;
}

/* Which shards have which case: bit i - 1 of held[case], shard i. */
static void hold(uint32_t held[CASES], uint32_t count, const char *reference)
{
    memset(held, 0, CASES * sizeof *held);
    for (uint32_t i = 1; i <= count; i++) {
        fm_plan plan = make_shard(i, count, reference);
        for (size_t j = 0; j < plan.count; j++)
            held[strtoul(plan.cases[j].id, NULL, 16)] |= 1u << (i - 1);
        plan_free(&plan);
    }
}

static void shards_hold_each_case_once(void **state)
{
    (void)state;
    uint32_t held[CASES];
    for (uint32_t count = 1; count <= 31; count += 5) {
        hold(held, count, "none");
        for (size_t i = 0; i < CASES; i++)
            assert_true(held[i] != 0 && (held[i] & (held[i] - 1)) == 0);
    }
}

static void what_is_compared_stays_together(void **state)
{
    (void)state;
    uint32_t held[CASES];
    hold(held, 7, "none");
    for (size_t i = 0; i < CASES; i++)
        assert_int_equal(held[i], held[i - i % METHODS]);
}

static void layers_that_grow_with_k_stay_together(void **state)
{
    (void)state;
    for (uint32_t i = 1; i <= 4; i++) {
        fm_plan plan = make_plan();
        const fm_shard_desc desc = { .index = i, .count = 4, .reference = "none" };
        fm_error err = { 0 };
        for (size_t j = 0; j < plan.count; j++)
            plan.cases[j].settings.r = 1;
        assert_int_equal(plan_shard(&plan, &desc, &err), FM_OK);
        assert_true(plan.count == 0 || plan.count == CASES / 2); /* one feed each */
        plan_free(&plan);
    }
}

static void shortest_reference_of_each_feed_is_in_every_shard(void **state)
{
    (void)state;
    uint32_t held[CASES];
    size_t everywhere = 0;
    hold(held, 8, NULL);
    for (size_t i = 0; i < CASES; i++) {
        if ((held[i] & (held[i] - 1)) == 0)
            continue;
        assert_int_equal(held[i], 0xff);
        assert_true(i == 1 || i == CASES / 2 + 1); /* exact, one layer */
        everywhere++;
    }
    assert_int_equal(everywhere, 2);
}

static void named_reference_takes_the_place_of_exact(void **state)
{
    (void)state;
    uint32_t held[CASES];
    hold(held, 8, "kb");
    for (size_t i = 0; i < CASES; i++)
        assert_int_equal(held[i] == 0xff, i == 2 || i == CASES / 2 + 2);
}

/* No shard takes longer than the mean and the longest group. */
static void shards_take_about_as_long(void **state)
{
    (void)state;
    fm_plan whole = make_plan();
    double longest = 0.0;
    for (size_t i = 0; i < whole.count; i += METHODS) {
        double group = 0.0;
        for (size_t j = 0; j < METHODS; j++)
            group += plan_case_seconds(&whole, i + j);
        longest = group > longest ? group : longest;
    }
    for (uint32_t i = 1; i <= 5; i++) {
        fm_plan plan = make_shard(i, 5, "none");
        assert_true(plan_seconds(&plan) <= plan_seconds(&whole) / 5.0 + longest);
        assert_true(plan.count > 0);
        plan_free(&plan);
    }
    plan_free(&whole);
}

static void shard_knows_the_whole_plan(void **state)
{
    (void)state;
    char hash[17], first[17], second[17];
    fm_plan whole = make_plan(), one = make_shard(1, 2, NULL), other = make_shard(2, 2, NULL);
    plan_hash(hash, &whole, false, false);
    plan_hash(first, &one, false, false);
    plan_hash(second, &other, false, false);
    assert_string_equal(one.shard.plan, hash);
    assert_string_equal(other.shard.plan, hash);
    assert_string_equal(one.shard.table.bytes, other.shard.table.bytes);
    assert_string_not_equal(first, second);
    assert_int_equal(one.shard.case_count, CASES);
    assert_int_equal(one.shard.group_count, CASES / METHODS);
    plan_free(&whole);
    plan_free(&one);
    plan_free(&other);
}

/* Two shards that only have the references are not the same run. */
static void shards_without_own_cases_differ(void **state)
{
    (void)state;
    char first[17], second[17];
    fm_plan one = make_shard(99, 100, NULL), other = make_shard(100, 100, NULL);
    assert_int_equal(one.count, 2);
    assert_int_equal(other.count, 2);
    plan_hash(first, &one, false, false);
    plan_hash(second, &other, false, false);
    assert_string_not_equal(first, second);
    plan_free(&one);
    plan_free(&other);
}

static void unknown_reference_is_refused_with_the_nearest(void **state)
{
    (void)state;
    fm_plan plan = make_plan();
    const fm_shard_desc desc = { .index = 1, .count = 2, .reference = "exakt" };
    fm_error err = { 0 };
    assert_int_equal(plan_shard(&plan, &desc, &err), FM_INVALID);
    assert_non_null(strstr(err.message, "'exact'"));
    assert_int_equal(plan.count, CASES);
    assert_int_equal(plan.shard.count, 0);
    plan_free(&plan);
}

static void parse_takes_what_is_legal_only(void **state)
{
    (void)state;
    static const char *const wrong[] = { "",       "2",     "/2",
                                         "2/",     "0/2",   "3/2",
                                         "1/0",    "a/b",   "1/2x",
                                         "1/1001", "1/2/3", "-1/2",
                                         " 1/2",   "1.0/2", "99999999999999999999999999999999/2" };
    fm_shard_desc desc = { 0 };
    fm_error err = { 0 };
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        assert_int_equal(shard_parse(&desc, wrong[i], &err), FM_INVALID);
        assert_int_equal(desc.count, 0);
    }
    assert_int_equal(shard_parse(&desc, "16/16", &err), FM_OK);
    assert_int_equal(desc.index, 16);
    assert_int_equal(desc.count, 16);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(shards_hold_each_case_once),
        cmocka_unit_test(what_is_compared_stays_together),
        cmocka_unit_test(layers_that_grow_with_k_stay_together),
        cmocka_unit_test(shortest_reference_of_each_feed_is_in_every_shard),
        cmocka_unit_test(named_reference_takes_the_place_of_exact),
        cmocka_unit_test(shards_take_about_as_long),
        cmocka_unit_test(shard_knows_the_whole_plan),
        cmocka_unit_test(shards_without_own_cases_differ),
        cmocka_unit_test(unknown_reference_is_refused_with_the_nearest),
        cmocka_unit_test(parse_takes_what_is_legal_only),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
