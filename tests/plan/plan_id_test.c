/* What the id of a case holds. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "devices.h"
#include "plan/plan.h"

static const fm_method_desc usual = {
    .id = "kb",
    .version = "1",
    .options = { { .name = "layout", .values = { "pixel", "layer" } } },
    .passes = { { .name = "store", .exclusive = true } },
};
static const fm_method_desc changed = {
    .id = "kb",
    .version = "1",
    .options = { { .name = "layout", .values = { "layer", "pixel" } } },
    .passes = { { .name = "store", .exclusive = true } },
};

/* The id of kb's one case, and its layout. */
static void id_of(char id[17], const char *layout, const fm_method_desc *method, const char *axis)
{
    const char *const methods[] = { "kb", NULL }, *const axes[] = { axis, NULL };
    fm_plugin plugin = { .method = method };
    fm_plugin_entry entry = { .id = "kb", .plugin = &plugin };
    const fm_plugin_list list = { .entries = &entry, .count = 1 };
    const fm_plan_request request = { .known_devices = &program_devices,
                                      .methods = methods,
                                      .axes = axes };
    fm_plan plan;
    fm_error err = { .message = "" };
    if (plan_expand(&plan, &request, &list, &err) != FM_OK)
        fail_msg("%s", err.message);
    assert_int_equal(plan.count, 1);
    assert_int_equal(plan.cases[0].choice_count, 1);
    assert_string_equal(plan.cases[0].choices[0].value, layout);
    snprintf(id, 17, "%s", plan.cases[0].id);
    plan_free(&plan);
}

static void default_that_is_said_is_the_same_case(void **state)
{
    (void)state;
    char unsaid[17], said[17], other[17];
    id_of(unsaid, "pixel", &usual, NULL);
    id_of(said, "pixel", &usual, "layout=pixel");
    id_of(other, "layer", &usual, "layout=layer");
    assert_string_equal(said, unsaid);
    assert_string_not_equal(other, unsaid);
}

static void case_ids_tell_cases_apart_and_nothing_else(void **state)
{
    (void)state;
    static const char *const others[] = { "k=4", "seed=2", "buffers=bound", "pool=per-frame",
                                          "timers=frame" };
    static const char *const same[] = { "launches=9", "frames=3", "warmup=1" };
    char first[17], id[17];
    id_of(first, "pixel", &usual, NULL);
    assert_int_equal(strlen(first), 16);
    for (size_t i = 0; i < sizeof same / sizeof same[0]; i++) {
        id_of(id, "pixel", &usual, same[i]);
        assert_string_equal(id, first);
    }
    for (size_t i = 0; i < sizeof others / sizeof others[0]; i++) {
        id_of(id, "pixel", &usual, others[i]);
        assert_string_not_equal(id, first);
    }
}

/* Who changes a default must not find yesterday's rows under the ids of today's. */
static void changed_default_is_another_case(void **state)
{
    (void)state;
    char before[17], after[17], said[17];
    id_of(before, "pixel", &usual, NULL);
    id_of(after, "layer", &changed, NULL);
    id_of(said, "pixel", &changed, "layout=pixel");
    assert_string_not_equal(after, before);
    assert_string_equal(said, before);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(default_that_is_said_is_the_same_case),
        cmocka_unit_test(changed_default_is_another_case),
        cmocka_unit_test(case_ids_tell_cases_apart_and_nothing_else),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
