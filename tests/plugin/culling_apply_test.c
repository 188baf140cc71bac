/* The transform of a method's pass list; what it does to fragments is culling_test's and
 * lemma_test's.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>
#include <string.h>

#include "plugin/culling_apply.h"

static fm_method_desc make_method(void)
{
    return (fm_method_desc){
        .id = "kb",
        .keeps = FM_KEEPS_K_NEAREST,
        .resources = { { .name = "counters", .extent = { .per_pixel = 1 } },
                       { .name = "fragments",
                         .element = FM_ELEMENT_UVEC2,
                         .extent = { .per_pixel_k = 1 } },
                       { .name = "samples",
                         .kind = FM_RESOURCE_IMAGE,
                         .format = FM_FORMAT_RGBA8,
                         .samples_per_k = 1 },
                       { .name = "depth", .kind = FM_RESOURCE_IMAGE, .format = FM_FORMAT_D32F } },
        .passes = { { .name = "clear", .kind = FM_PASS_CLEAR, .writes = { "counters" } },
                    { .name = "store", .shader = "store.glsl", .writes = { "fragments" } },
                    { .name = "route",
                      .shader = "route.glsl",
                      .targets = { { .resource = "samples" } } },
                    { .name = "peel",
                      .shader = "peel.glsl",
                      .reads = { "counters" },
                      .state = { .depth_stencil = "depth", .depth_test = FM_COMPARE_LESS } },
                    { .name = "resolve", .kind = FM_PASS_PIXELS, .shader = "resolve.glsl" },
                    { .name = "bounds", .shader = "bounds.glsl", .cover = FM_COVER_HULL } },
    };
}

static fm_settings make_settings(const char *const *texts)
{
    fm_settings settings;
    settings_default(&settings);
    settings_set(&settings, key_find("culling"), "occupancy", NULL);
    for (; texts != NULL && *texts != NULL; texts += 2)
        assert_int_equal(settings_set(&settings, key_find(texts[0]), texts[1], NULL), FM_OK);
    return settings;
}

#define TEXTS(...) ((const char *const[]){ __VA_ARGS__, NULL })

static fm_method_desc applied(const char *const *texts)
{
    fm_method_desc culled;
    fm_error err = { .message = "" };
    const fm_method_desc method = make_method();
    const fm_settings settings = make_settings(texts);
    const fm_culling_desc desc = { .settings = &settings, .feed = FM_FEED_RASTER };
    if (culling_apply(&culled, &method, &desc, &err) != FM_OK)
        fail_msg("%s", err.message);
    return culled;
}

static void without_culling_the_method_is_as_it_was(void **state)
{
    (void)state;
    const fm_method_desc culled = applied(TEXTS("culling", "none")), method = make_method();
    assert_string_equal(culled.passes[0].name, "clear");
    assert_null(culled.passes[1].state.depth_stencil);
    assert_null(culled.resources[4].name);
    assert_false(culling_is_applied(&culled));
    assert_int_equal(culled.keeps, method.keeps);
}

static void the_map_is_made_before_the_method_begins(void **state)
{
    (void)state;
    static const char *const names[] = { "cull-clear", "cull-range", "cull-fill", "cull-count",
                                         "clear",      "store",      "route",     "peel",
                                         "resolve",    "bounds" };
    const fm_method_desc culled = applied(NULL);
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++)
        assert_string_equal(culled.passes[i].name, names[i]);
    assert_null(culled.passes[sizeof names / sizeof names[0]].name);
    assert_int_equal(culled.passes[1].cover, FM_COVER_HULL);
    assert_int_equal(applied(TEXTS("cull_range", "aabb")).passes[1].cover, FM_COVER_BOX);
    assert_int_equal(applied(TEXTS("cull_range", "exact")).passes[1].cover, FM_COVER_NONE);
    assert_true(culling_is_applied(&culled));
}

static void passes_without_depth_test_before_the_shader(void **state)
{
    (void)state;
    const fm_pass store = applied(NULL).passes[5];
    assert_string_equal(store.state.depth_stencil, "fm_cull_boundary");
    assert_int_equal(store.state.depth_test, FM_COMPARE_LESS_EQUAL);
    assert_true(store.state.early_tests);
    assert_false(store.state.depth_write);
    assert_null(store.reads[0]);
}

static void passes_that_own_depth_or_samples_test_in_the_shader(void **state)
{
    (void)state;
    const fm_method_desc culled = applied(NULL);
    assert_null(culled.passes[6].state.depth_stencil);
    assert_string_equal(culled.passes[6].reads[0], "fm_cull_boundary");
    assert_string_equal(culled.passes[7].state.depth_stencil, "depth");
    assert_string_equal(culled.passes[7].reads[1], "fm_cull_boundary");
    const fm_pass store = applied(TEXTS("cull_test", "shader")).passes[5];
    assert_null(store.state.depth_stencil);
    assert_string_equal(store.reads[0], "fm_cull_boundary");
    assert_null(culled.passes[8].reads[0]); /* not over the scene */
}

/* Passes of the method until the one that tests depth, with what the texts say. */
static fm_status check_reversed(fm_error *err, const char *const *texts, bool without_peel)
{
    fm_method_desc method = make_method();
    const fm_settings settings = make_settings(texts);
    for (size_t i = 0; without_peel && i < FM_MAX_PASSES; i++)
        method.passes[i].state.depth_test = FM_COMPARE_OFF;
    return culling_check(&method, &settings, FM_FEED_RASTER, err);
}

static void a_reversed_projection_has_no_depth_test_of_a_pass(void **state)
{
    (void)state;
    fm_error err = { .message = "" };
    assert_int_equal(check_reversed(&err, TEXTS("culling", "none"), false), FM_OK);
    assert_int_equal(check_reversed(&err, TEXTS("culling", "none", "depth", "reversed"), false),
                     FM_UNSUPPORTED);
    assert_int_equal(err.reason, FM_REASON_DEPTH_TEST);
    assert_non_null(strstr(err.message, "pass 'peel'"));
    assert_non_null(strstr(err.message, "attachment 'depth'"));
    assert_int_equal(check_reversed(&err, TEXTS("culling", "none", "depth", "reversed"), true),
                     FM_OK);
}

static void a_reversed_projection_is_culled_in_the_shader_only(void **state)
{
    (void)state;
    fm_error err = { .message = "" };
    assert_int_equal(check_reversed(&err, TEXTS("depth", "reversed"), true), FM_UNSUPPORTED);
    assert_int_equal(err.reason, FM_REASON_DEPTH_TEST);
    assert_non_null(strstr(err.message, "pass 'store'"));
    assert_non_null(strstr(err.message, "fm_cull_boundary"));
    assert_int_equal(check_reversed(&err, TEXTS("depth", "reversed", "cull_test", "shader"), true),
                     FM_OK);
}

static void the_map_lies_in_the_largest_buffer_if_asked(void **state)
{
    (void)state;
    assert_null(applied(NULL).resources[6].shares);
    const fm_method_desc shared = applied(TEXTS("cull_memory", "shared"));
    assert_string_equal(shared.resources[6].shares, "fragments");
    assert_int_equal(shared.resources[6].extent.per_pixel, 32);
    assert_int_equal(shared.passes[0].kind, FM_PASS_PIXELS); /* clears its part alone */
}

/* The method's two scene passes without depth, and a target of many layers, which is drawn into its
 * first. */
static void each_scene_pass_tests_for_itself(void **state)
{
    (void)state;
    fm_method_desc culled, method = make_method();
    const fm_settings settings = make_settings(NULL);
    const fm_culling_desc desc = { .settings = &settings, .feed = FM_FEED_RASTER };
    method.resources[2].samples_per_k = 0;
    method.resources[2].layers = 8;
    assert_int_equal(culling_apply(&culled, &method, &desc, NULL), FM_OK);
    for (size_t i = 5; i <= 6; i++) {
        assert_string_equal(culled.passes[i].state.depth_stencil, "fm_cull_boundary");
        assert_true(culled.passes[i].state.early_tests);
        assert_false(culled.passes[i].state.depth_write);
        assert_int_equal(culled.passes[i].state.depth_stencil_load, FM_LOAD_KEEP);
    }
}

/* What is largest depends on options and on the scene: 8 bytes a pixel for each of 4 slots or of 16
 * fragments, beside 24. */
static void the_largest_buffer_is_as_options_and_n_make_it(void **state)
{
    (void)state;
    const fm_settings settings = make_settings(TEXTS("cull_memory", "shared"));
    const fm_choice one = { "slots", "1" };
    fm_method_desc culled, method = make_method();
    fm_culling_desc desc = { .settings = &settings, .feed = FM_FEED_RASTER };
    method.options[0] = (fm_option){ .name = "slots", .values = { "4", "1" } };
    method.resources[0].extent = (fm_extent){ .per_pixel = 6 };
    method.resources[1].extent = (fm_extent){ .per_pixel_option = 1, .option = "slots" };
    assert_int_equal(culling_apply(&culled, &method, &desc, NULL), FM_OK);
    assert_string_equal(culled.resources[6].shares, "fragments");
    desc.choices = &one;
    desc.choice_count = 1;
    assert_int_equal(culling_apply(&culled, &method, &desc, NULL), FM_OK);
    assert_string_equal(culled.resources[6].shares, "counters");
    method.resources[1].extent = (fm_extent){ .per_pixel_n = 1 };
    desc.n = 16;
    assert_int_equal(culling_apply(&culled, &method, &desc, NULL), FM_OK);
    assert_string_equal(culled.resources[6].shares, "fragments");
}

/* A hull's back faces lie behind the boundary, and are no fragments. */
static void passes_over_a_cover_are_left_alone(void **state)
{
    (void)state;
    const fm_pass early = applied(NULL).passes[9];
    assert_null(early.state.depth_stencil);
    assert_null(early.reads[0]);
    assert_null(applied(TEXTS("cull_test", "shader")).passes[9].reads[0]);
}

static void refuses(const fm_method_desc *method, const char *const *texts, uint32_t feed,
                    fm_reason reason, const char *message)
{
    fm_method_desc culled;
    fm_error err = { .message = "" };
    const fm_settings settings = make_settings(texts);
    const fm_culling_desc desc = { .settings = &settings, .feed = feed };
    assert_int_equal(culling_apply(&culled, method, &desc, &err), FM_UNSUPPORTED);
    assert_int_equal(err.reason, reason);
    if (strstr(err.message, message) == NULL)
        fail_msg("'%s' is not in: %s", message, err.message);
}

static void what_cannot_be_culled_is_refused_with_the_reason(void **state)
{
    (void)state;
    fm_method_desc method = make_method();
    refuses(&method, NULL, FM_FEED_COMPUTE_LAYER, FM_REASON_SETTING, "feed raster only");
    refuses(&method, TEXTS("k", "33", "cull_words", "1"), FM_FEED_RASTER, FM_REASON_SETTING,
            "32 buckets are fewer than k = 33");
    refuses(&method, TEXTS("width_px", "16384", "height_px", "16384"), FM_FEED_RASTER,
            FM_REASON_SUITE_LIMIT, "the map is over 2^32 words");
    for (size_t i = 5; i < FM_MAX_PASSES - 3; i++)
        method.passes[i] = method.passes[4];
    refuses(&method, NULL, FM_FEED_RASTER, FM_REASON_SUITE_LIMIT, "no room for 4 passes");
    method = make_method();
    method.k_total = "k";
    refuses(&method, NULL, FM_FEED_RASTER, FM_REASON_SETTING, "to choose its k");
    method.keeps = FM_KEEPS_ALL;
    refuses(&method, NULL, FM_FEED_RASTER, FM_REASON_SETTING, "other fragments than the k nearest");
}

/* The option's other value has the buffer, in which there is room. */
static void the_map_has_no_room_in_an_image(void **state)
{
    (void)state;
    const fm_settings settings = make_settings(TEXTS("cull_memory", "shared"));
    const fm_choice in_image = { "layout", "image" };
    fm_error err = { .message = "" };
    fm_method_desc culled, method = make_method();
    fm_culling_desc desc = { .settings = &settings, .feed = FM_FEED_RASTER };
    size_t count = resource_count(&method);
    method.options[0] = (fm_option){ .name = "layout", .values = { "pixel", "image" } };
    method.resources[count] = (fm_resource){ .name = "fragments",
                                             .kind = FM_RESOURCE_IMAGE,
                                             .format = FM_FORMAT_RG32UI,
                                             .extent = { .per_pixel_k = 1 },
                                             .when_option = "layout",
                                             .when_value = "image" };
    assert_int_equal(culling_apply(&culled, &method, &desc, &err), FM_OK);
    assert_string_equal(culled.resources[count + 2].shares, "fragments");
    desc.choices = &in_image;
    desc.choice_count = 1;
    assert_int_equal(culling_apply(&culled, &method, &desc, &err), FM_UNSUPPORTED);
    assert_int_equal(err.reason, FM_REASON_SETTING);
    assert_non_null(strstr(err.message, "with layout = image 'fragments' is an image"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(without_culling_the_method_is_as_it_was),
        cmocka_unit_test(the_map_is_made_before_the_method_begins),
        cmocka_unit_test(passes_without_depth_test_before_the_shader),
        cmocka_unit_test(passes_that_own_depth_or_samples_test_in_the_shader),
        cmocka_unit_test(passes_over_a_cover_are_left_alone),
        cmocka_unit_test(a_reversed_projection_has_no_depth_test_of_a_pass),
        cmocka_unit_test(a_reversed_projection_is_culled_in_the_shader_only),
        cmocka_unit_test(the_map_lies_in_the_largest_buffer_if_asked),
        cmocka_unit_test(each_scene_pass_tests_for_itself),
        cmocka_unit_test(the_largest_buffer_is_as_options_and_n_make_it),
        cmocka_unit_test(the_map_has_no_room_in_an_image),
        cmocka_unit_test(what_cannot_be_culled_is_refused_with_the_reason),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
