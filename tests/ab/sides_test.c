/* BASE and NEW: what names them, which cases both have, and whose launch is first. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "ab/pairs.h"

enum { CASES = 4 };

/* A plan by hand; its reasons to skip cases are freed. */
typedef struct made_plan {
    fm_case cases[CASES];
    fm_plan plan;
} made_plan;

static void add_case(made_plan *of, const char *method, uint32_t k)
{
    fm_case *made = &of->cases[of->plan.count++];
    *made = (fm_case){ .scene = "layers", .device = "dummy", .feed = "raster" };
    snprintf(made->method, sizeof made->method, "%s", method);
    settings_default(&made->settings);
    made->settings.k = k;
    of->plan.cases = of->cases;
}

static void free_made(made_plan *of)
{
    for (size_t i = 0; i < of->plan.count; i++)
        free(of->cases[i].skip);
}

static void refuse(fm_case *of, fm_case_status status)
{
    of->skip = strdup("it cannot");
    of->skip_status = status;
}

static void method_and_folder_are_parted_at_the_first_at(void **state)
{
    (void)state;
    char method[64];
    const char *folder;
    fm_error err = { 0 };
    assert_int_equal(side_parse(method, &folder, "kb@/tmp/a@b", NULL), FM_OK);
    assert_string_equal(method, "kb");
    assert_string_equal(folder, "/tmp/a@b");
    assert_int_equal(side_parse(method, &folder, "kb", &err), FM_INVALID);
    assert_non_null(strstr(err.message, "METHOD@DIR"));
    assert_int_equal(side_parse(method, &folder, "@dir", NULL), FM_INVALID);
    assert_int_equal(side_parse(method, &folder, "kb@", NULL), FM_INVALID);
}

static void cases_are_joined_by_what_they_were_asked_for(void **state)
{
    (void)state;
    made_plan base = { .plan.count = 0 }, now = { .plan.count = 0 };
    ab_pairs pairs;
    add_case(&base, "kb", 4);
    add_case(&base, "kb", 8);
    add_case(&base, "ab-ll", 0);
    add_case(&now, "ab-ll", 0);
    add_case(&now, "kb", 8);
    add_case(&now, "kb", 16);
    assert_int_equal(sides_join(&pairs, &base.plan, &now.plan, NULL), FM_OK);
    assert_int_equal(pairs.count, 2);
    assert_int_equal(pairs.items[0].at[AB_BASE], 1);
    assert_int_equal(pairs.items[0].at[AB_NEW], 1);
    assert_int_equal(pairs.items[1].at[AB_BASE], 2);
    assert_int_equal(pairs.items[1].at[AB_NEW], 0);
    assert_int_equal(pairs.unpaired, 2);
    assert_string_equal(base.cases[0].skip, "NEW has no such case");
    assert_string_equal(now.cases[2].skip, "BASE has no such case");
    assert_null(now.cases[1].skip);
    sides_free(&pairs);
    free_made(&base);
    free_made(&now);
}

static void two_methods_can_be_compared_where_each_side_has_one(void **state)
{
    (void)state;
    made_plan base = { .plan.count = 0 }, now = { .plan.count = 0 };
    ab_pairs pairs;
    add_case(&base, "kplus-heap", 8);
    add_case(&now, "kplus-array", 8);
    assert_int_equal(sides_join(&pairs, &base.plan, &now.plan, NULL), FM_OK);
    assert_int_equal(pairs.count, 1);
    sides_free(&pairs);
    add_case(&base, "kb", 8);
    assert_int_equal(sides_join(&pairs, &base.plan, &now.plan, NULL), FM_INVALID);
    free_made(&base);
    free_made(&now);
}

static void what_one_side_cannot_run_is_not_run_on_the_other(void **state)
{
    (void)state;
    made_plan base = { .plan.count = 0 }, now = { .plan.count = 0 };
    ab_pairs pairs;
    for (uint32_t k = 1; k <= 2; k++) {
        add_case(&base, "kb", k);
        add_case(&now, "kb", k);
    }
    refuse(&now.cases[0], FM_CASE_NOT_SUPPORTED);
    refuse(&now.cases[1], FM_CASE_NOT_SUPPORTED);
    refuse(&base.cases[1], FM_CASE_NOT_SUPPORTED);
    assert_int_equal(sides_join(&pairs, &base.plan, &now.plan, NULL), FM_OK);
    assert_int_equal(pairs.count, 1);
    assert_int_equal(pairs.refused, 1);
    assert_string_equal(base.cases[0].skip, "NEW cannot run it");
    sides_free(&pairs);
    free_made(&base);
    free_made(&now);
}

static void refused_method_stands_for_all_its_cases(void **state)
{
    (void)state;
    made_plan base = { .plan.count = 0 }, now = { .plan.count = 0 };
    ab_pairs pairs;
    add_case(&base, "kb", 4);
    add_case(&base, "kb", 8);
    add_case(&base, "ab-ll", 0);
    add_case(&now, "kb", 0);
    add_case(&now, "ab-ll", 0);
    refuse(&now.cases[0], FM_CASE_PLUGIN_ERROR);
    assert_int_equal(sides_join(&pairs, &base.plan, &now.plan, NULL), FM_OK);
    assert_int_equal(pairs.count, 3);
    assert_int_equal(pairs.items[0].at[AB_NEW], 0);
    assert_int_equal(pairs.items[1].at[AB_NEW], 0);
    assert_int_equal(pairs.unpaired, 0);
    sides_free(&pairs);
    free_made(&base);
    free_made(&now);
}

static void sides_take_turns_and_cases_begin_by_the_seed(void **state)
{
    (void)state;
    uint32_t begin_with_new = 0;
    for (size_t index = 0; index < 64; index++) {
        for (uint32_t pair = 0; pair < 40; pair++)
            assert_int_not_equal(pairs_first_side(3, index, pair),
                                 pairs_first_side(3, index, pair + 1));
        begin_with_new += pairs_first_side(3, index, 0) == AB_NEW;
    }
    assert_true(begin_with_new > 16 && begin_with_new < 48);
}

/* By the id of either side; the partner's id is another one. */
static void chosen_cases_stay_with_their_partners(void **state)
{
    made_plan base = { 0 }, now = { 0 };
    fm_text_list ids = { 0 };
    fm_error err = { 0 };
    (void)state;
    for (uint32_t k = 1; k <= CASES; k++) {
        add_case(&base, "kb", k);
        add_case(&now, "kb", k);
        snprintf(base.cases[k - 1].id, sizeof base.cases[0].id, "old%u", k);
        snprintf(now.cases[k - 1].id, sizeof now.cases[0].id, "new%u", k);
    }
    assert_true(text_list_add(&ids, "new2") && text_list_add(&ids, "old4"));
    assert_int_equal(sides_choose(&base.plan, &now.plan, &ids, NULL), FM_OK);
    assert_int_equal(base.plan.count, 2);
    assert_int_equal(now.plan.count, 2);
    assert_string_equal(base.plan.cases[0].id, "old2");
    assert_string_equal(now.plan.cases[1].id, "new4");
    assert_true(text_list_add(&ids, "new9"));
    assert_int_equal(sides_choose(&base.plan, &now.plan, &ids, &err), FM_INVALID);
    assert_non_null(strstr(err.message, "new9"));
    text_list_free(&ids);
    free_made(&now);
    free_made(&base);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(method_and_folder_are_parted_at_the_first_at),
        cmocka_unit_test(cases_are_joined_by_what_they_were_asked_for),
        cmocka_unit_test(two_methods_can_be_compared_where_each_side_has_one),
        cmocka_unit_test(what_one_side_cannot_run_is_not_run_on_the_other),
        cmocka_unit_test(chosen_cases_stay_with_their_partners),
        cmocka_unit_test(refused_method_stands_for_all_its_cases),
        cmocka_unit_test(sides_take_turns_and_cases_begin_by_the_seed),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
