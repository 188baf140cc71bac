/* Which methods may be composited how. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "devices.h"
#include "plan/plan.h"

#define RESOLVES .passes = { { .name = "resolve", .kind = FM_PASS_PIXELS, .emits = true } }

static const fm_method_desc methods[] = {
    { .id = "both", .version = "1", .traits = FM_TRAIT_EMITS_BACK, RESOLVES },
    { .id = "either", .version = "1", .traits = FM_TRAIT_EMITS_EITHER, RESOLVES },
    { .id = "floor", .version = "1", .traits = FM_TRAIT_FLOOR },
    { .id = "front", .version = "1", RESOLVES },
};
enum { METHODS = sizeof methods / sizeof methods[0] };

/* All methods with one axis. */
static void make_plan(fm_plan *plan, const char *axis)
{
    const char *const axes[] = { axis, NULL };
    const char *ids[METHODS + 1] = { NULL };
    fm_plugin plugins[METHODS];
    fm_plugin_entry entries[METHODS];
    fm_error err = { .message = "" };
    for (size_t i = 0; i < METHODS; i++) {
        ids[i] = methods[i].id;
        plugins[i] = (fm_plugin){ .method = &methods[i] };
        entries[i] = (fm_plugin_entry){ .plugin = &plugins[i] };
        snprintf(entries[i].id, sizeof entries[i].id, "%s", methods[i].id);
    }
    const fm_plugin_list list = { .entries = entries, .count = METHODS };
    const fm_plan_request request = { .known_devices = &program_devices,
                                      .methods = ids,
                                      .axes = axes };
    if (plan_expand(plan, &request, &list, &err) != FM_OK)
        fail_msg("%s", err.message);
}

static void back_to_front_needs_a_method_that_can_turn_round(void **state)
{
    (void)state;
    fm_plan plan;
    make_plan(&plan, "composite=back-to-front");
    assert_int_equal(plan.count, METHODS);
    assert_string_equal(plan.cases[0].skip,
                        "composite = back-to-front: both hands over from both ends");
    assert_null(plan.cases[1].skip);
    assert_string_equal(plan.cases[3].skip,
                        "composite = back-to-front: front hands over front to back");
    assert_int_equal(plan.cases[3].skip_status, FM_CASE_NOT_SUPPORTED);
    assert_int_equal(plan.cases[3].skip_reason, FM_REASON_SETTING);
    plan_free(&plan);
}

/* A floor has no image that could be rounded: one case, and no reason against it. */
static void floors_are_composited_in_no_way(void **state)
{
    (void)state;
    unsigned floors = 0;
    fm_plan plan;
    make_plan(&plan, "accumulate=float32,float16,unorm8");
    assert_int_equal(plan.count, 3 * (METHODS - 1) + 1);
    for (size_t i = 0; i < plan.count; i++)
        floors += strcmp(plan.cases[i].method, "floor") == 0;
    assert_int_equal(floors, 1);
    plan_free(&plan);
    make_plan(&plan, "composite=back-to-front");
    assert_null(plan.cases[2].skip);
    assert_int_equal(plan.cases[2].settings.composite, FM_COMPOSITE_FRONT_TO_BACK);
    plan_free(&plan);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(back_to_front_needs_a_method_that_can_turn_round),
        cmocka_unit_test(floors_are_composited_in_no_way),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
