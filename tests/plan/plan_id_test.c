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

/* Records in a buffer or, under `auto` on a GPU, on layers of an image. */
static const fm_method_desc open_layout = {
    .id = "kb",
    .version = "1",
    .traits = FM_TRAIT_BOUNDED,
    .keeps = FM_KEEPS_K_NEAREST,
    .options = { { .name = "layout", .values = { "auto", "layer", "pixel", "image" } } },
    .resources = { { .name = "records", .extent = { .per_pixel_k = 2 } },
                   { .name = "records",
                     .kind = FM_RESOURCE_IMAGE,
                     .format = FM_FORMAT_RG32UI,
                     .extent = { .per_pixel_k = 1 },
                     .when_option = "layout",
                     .when_value = "image" } },
    .passes = { { .name = "store", .exclusive = true } },
};

/* Answers of devices; the context counts who asks. */
static fm_status ask_gpu(fm_auto_device *device, const void *context, const char *name,
                         fm_error *err)
{
    (void)err;
    ++**(unsigned *const *)context;
    assert_string_equal(name, "vulkan");
    *device = (fm_auto_device){ .image_layers = 16, .image_max_bytes = 1 << 30 };
    return FM_OK;
}

static fm_status ask_nobody(fm_auto_device *device, const void *context, const char *name,
                            fm_error *err)
{
    (void)device;
    ++**(unsigned *const *)context;
    return fm_fail(err, FM_IO, "%s: no driver", name);
}

typedef fm_status asker(fm_auto_device *, const void *, const char *, fm_error *);

static void expand_open(fm_plan *plan, const fm_method_desc *method, const char *axis, asker *ask,
                        unsigned *asked)
{
    const char *const methods[] = { "kb", NULL }, *const axes[] = { axis, NULL };
    fm_plugin plugin = { .method = method };
    fm_plugin_entry entry = { .id = "kb", .plugin = &plugin };
    const fm_plugin_list list = { .entries = &entry, .count = 1 };
    const fm_plan_request request = { .known_devices = &program_devices,
                                      .methods = methods,
                                      .axes = axes,
                                      .ask = ask,
                                      .context = &asked };
    fm_error err = { .message = "" };
    *asked = 0;
    if (plan_expand(plan, &request, &list, &err) != FM_OK)
        fail_msg("%s", err.message);
}

/* Above the device's layers it is the next layout that the method has. */
static void an_open_layout_is_what_it_means_on_the_device(void **state)
{
    (void)state;
    fm_plan plan;
    unsigned asked;
    char id[17];
    expand_open(&plan, &open_layout, "k=8,16,17", ask_gpu, &asked);
    assert_int_equal(asked, 1);
    assert_int_equal(plan.unknown.status, FM_OK);
    assert_int_equal(plan.count, 3);
    assert_string_equal(plan.cases[0].choices[0].value, "image");
    assert_string_equal(plan.cases[1].choices[0].value, "image");
    assert_string_equal(plan.cases[2].choices[0].value, "layer");
    assert_int_equal(plan.cases[0].worked_out, 1u);
    snprintf(id, sizeof id, "%s", plan.cases[0].id);
    plan_free(&plan);
    expand_open(&plan, &open_layout, "layout=image", ask_gpu, &asked);
    assert_int_equal(asked, 0);
    assert_int_equal(plan.cases[0].worked_out, 0u);
    assert_string_equal(plan.cases[0].id, id); /* k is 8 unless it is told */
    plan_free(&plan);
    expand_open(&plan, &usual, NULL, ask_gpu, &asked);
    assert_int_equal(asked, 0);
    plan_free(&plan);
}

static void a_device_that_cannot_be_asked_leaves_a_layout_open(void **state)
{
    (void)state;
    fm_plan plan;
    unsigned asked;
    expand_open(&plan, &open_layout, "k=8,16", ask_nobody, &asked);
    assert_int_equal(asked, 1);
    assert_int_equal(plan.unknown.status, FM_IO);
    assert_string_equal(plan.unknown.message, "vulkan: no driver");
    assert_string_equal(plan.cases[1].choices[0].value, "auto");
    plan_free(&plan);
}

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
        cmocka_unit_test(an_open_layout_is_what_it_means_on_the_device),
        cmocka_unit_test(a_device_that_cannot_be_asked_leaves_a_layout_open),
        cmocka_unit_test(default_that_is_said_is_the_same_case),
        cmocka_unit_test(changed_default_is_another_case),
        cmocka_unit_test(case_ids_tell_cases_apart_and_nothing_else),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
