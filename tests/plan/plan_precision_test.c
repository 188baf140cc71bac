/* Plans with a precision: how often their cases may be launched. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>
#include <math.h>

#include "devices.h"
#include "plan/plan.h"

static const fm_method_desc method = {
    .id = "kb",
    .version = "1",
    .passes = { { .name = "resolve", .kind = FM_PASS_PIXELS, .emits = true } },
};

static fm_status try_plan(fm_plan *plan, const char *const *feeds, const char *const *axes,
                          fm_error *err)
{
    static const char *const ids[] = { "kb", NULL }, *const devices[] = { "tbr", "vulkan", NULL };
    fm_plugin plugin = { .method = &method };
    fm_plugin_entry entry = { .id = "kb", .plugin = &plugin };
    const fm_plugin_list list = { .entries = &entry, .count = 1 };
    const fm_plan_request request = { .known_devices = &program_devices,
                                      .methods = ids,
                                      .devices = devices,
                                      .feeds = feeds,
                                      .axes = axes };
    return plan_expand(plan, &request, &list, err);
}

/* A case on each device and feed; some of them cannot run. */
static void make_plan(fm_plan *plan, const char *const *axes)
{
    static const char *const feeds[] = { "frames", "raster", NULL };
    fm_error err = { .message = "" };
    if (try_plan(plan, feeds, axes, &err) != FM_OK)
        fail_msg("%s", err.message);
}

#define LIST(...) ((const char *const[]){ __VA_ARGS__, NULL })

/* Simulated launches all say the same, and have no times. */
static void plan_with_a_precision_has_a_range_of_launches(void **state)
{
    static const struct {
        const char *axes[3];
        uint32_t least, most;
    } rows[] = {
        { { "precision=2%" }, 5, 40 },
        { { "launches=12", "precision=2%" }, 5, 12 },
        { { "launches=7", "precision=2%" }, 7, 7 }, /* one look */
        { { "launches=1000", "precision=0.5%" }, 5, 1000 },
        { { "launches=4", "precision=none" }, 4, 4 },
    };
    (void)state;
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        fm_plan plan;
        make_plan(&plan, rows[i].axes);
        assert_int_equal(plan.launches, rows[i].most);
        for (size_t j = 0; j < plan.count; j++) {
            const bool is_adaptive = plan.cases[j].settings.precision_percent > 0.0;
            if (strcmp(plan.cases[j].feed, "frames") == 0) {
                assert_false(is_adaptive);
                assert_int_equal(plan_case_launches(&plan, j), i == 4 ? 4 : 1);
                continue;
            }
            assert_true(is_adaptive == (i != 4));
            assert_int_equal(plan_case_launches(&plan, j), rows[i].most);
            assert_int_equal(plan_case_least_launches(&plan, j), rows[i].least);
        }
        plan_free(&plan);
    }
}

static void plan_that_ends_before_its_first_look_is_refused(void **state)
{
    fm_plan plan;
    fm_error err = { .message = "" };
    (void)state;
    assert_int_equal(try_plan(&plan, LIST("raster"), LIST("precision=2%", "launches=4"), &err),
                     FM_INVALID);
    assert_non_null(strstr(err.message, "launches = 4: with precision it is the most that there "
                                        "may be, and the first look is at 5"));
}

/* Who wants a number of launches gets no fewer. */
static void plans_that_are_merged_are_as_precise_as_any_wants(void **state)
{
    static const struct {
        const char *one, *other;
        uint32_t launches;
        double precision;
    } rows[] = {
        { "precision=2%", "precision=5%", 40, 2.0 },
        { "precision=2%", "launches=7", 40, 0.0 },
        { "launches=50", "precision=2%", 50, 0.0 },
    };
    (void)state;
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        fm_plan plan, other;
        make_plan(&plan, LIST(rows[i].one));
        make_plan(&other, LIST(rows[i].other));
        assert_int_equal(plan_merge(&plan, &other, NULL), FM_OK);
        const size_t last = plan.count - 1; /* raster */
        assert_string_equal(plan.cases[last].feed, "raster");
        assert_int_equal(plan_case_launches(&plan, last), rows[i].launches);
        assert_true(fabs(plan.cases[last].settings.precision_percent - rows[i].precision) < 1e-9);
        plan_free(&other);
        plan_free(&plan);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(plan_with_a_precision_has_a_range_of_launches),
        cmocka_unit_test(plan_that_ends_before_its_first_look_is_refused),
        cmocka_unit_test(plans_that_are_merged_are_as_precise_as_any_wants),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
