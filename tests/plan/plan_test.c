#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#include "base/text.h"
#include "devices.h"
#include "fragmark/technique.h"
#include "plan/plan.h"

static const fm_method_desc kb_method = {
    .id = "kb",
    .version = "1",
    .k_max = 32,
    .options = { { .name = "layout", .values = { "pixel", "layer" } } },
    .passes = { { .name = "store", .exclusive = true } },
};
static const fm_method_desc ab_method = {
    .id = "ab",
    .version = "1",
    .keeps = FM_KEEPS_ALL,
    .feeds = FM_FEED_RASTER,
    .options = { { .name = "layout", .values = { "pixel", "tile" } },
                 { .name = "page", .values = { "1", "2", "4" } } },
    .passes = { { .name = "store" } },
};
static const fm_method_desc null_method = {
    .id = "null",
    .version = "1",
    .keeps = FM_KEEPS_ALL,
    .traits = FM_TRAIT_CONTROL | FM_TRAIT_FLOOR,
};

/* Two methods, a control, and one that was refused. */
typedef struct fixture {
    fm_plugin plugins[3];
    fm_plugin_entry entries[4];
    fm_plugin_list list;
    fm_plan plan;
    fm_error err;
} fixture;

static void fixture_create(fixture *with)
{
    *with = (fixture){
        .plugins = { { .method = &ab_method },
                     { .method = &kb_method },
                     { .method = &null_method } },
        .entries = { { .id = "ab" }, { .id = "broken" }, { .id = "kb" }, { .id = "null" } },
    };
    with->entries[0].plugin = &with->plugins[0];
    with->entries[2].plugin = &with->plugins[1];
    with->entries[3].plugin = &with->plugins[2];
    fm_fail(&with->entries[1].error, FM_INVALID, "broken.so: abi");
    with->list = (fm_plugin_list){ .entries = with->entries, .count = 4 };
}

/* A list as requests have them. */
#define LIST(...) ((const char *const[]){ __VA_ARGS__, NULL })

static fm_status expand(fixture *with, const fm_plan_request *request)
{
    fm_plan_request complete = *request;
    complete.known_devices = &program_devices;
    plan_free(&with->plan);
    return plan_expand(&with->plan, &complete, &with->list, &with->err);
}

static void expect(fixture *with, const fm_plan_request *request, size_t count)
{
    if (expand(with, request) != FM_OK)
        fail_msg("%s", with->err.message);
    assert_int_equal(with->plan.count, count);
}

static void expect_refused(fixture *with, const fm_plan_request *request, const char *message)
{
    assert_int_equal(expand(with, request), FM_INVALID);
    assert_null(with->plan.cases);
    if (strstr(with->err.message, message) == NULL)
        fail_msg("'%s' lacks '%s'", with->err.message, message);
}

/* What expect_refused needs for one axis on the two methods. */
static void expect_axis_refused(fixture *with, const char *axis, const char *message)
{
    const fm_plan_request request = { .methods = LIST("kb", "ab"), .axes = LIST(axis) };
    expect_refused(with, &request, message);
}

static void plan_of_nothing_is_every_method_but_controls(void **state)
{
    (void)state;
    fixture with;
    fixture_create(&with);
    expect(&with, &(fm_plan_request){ 0 }, 2); /* and but the one that is broken */
    assert_string_equal(with.plan.cases[0].method, "ab");
    assert_string_equal(with.plan.cases[1].method, "kb");
    assert_string_equal(with.plan.cases[1].scene, "layers");
    assert_string_equal(with.plan.cases[1].device, "vulkan");
    assert_string_equal(with.plan.cases[1].feed, "raster");
    assert_int_equal(with.plan.launches, 5);
    expect(&with, &(fm_plan_request){ .methods = LIST("all", "null", "kb") }, 3);
    plan_free(&with.plan);
}

static void plan_tells_a_refused_method_that_is_named(void **state)
{
    (void)state;
    fixture with;
    fixture_create(&with);
    expect(&with, &(fm_plan_request){ .methods = LIST("broken", "kb") }, 2);
    assert_string_equal(with.plan.cases[0].method, "broken");
    assert_string_equal(with.plan.cases[0].skip, "broken.so: abi");
    assert_int_equal(with.plan.cases[0].skip_status, FM_CASE_PLUGIN_ERROR);
    assert_int_equal(with.plan.cases[0].skip_reason, FM_REASON_NONE);
    expect_refused(&with, &(fm_plan_request){ .methods = LIST("broken") },
                   "method 'broken' is refused: broken.so: abi");
    expect_refused(&with,
                   &(fm_plan_request){ .methods = LIST("broken", "kb"), .axes = LIST("pag=2") },
                   "no key 'pag', and method 'broken' is refused: broken.so: abi");
    plan_free(&with.plan);
}

static void plan_launches_simulated_cases_once(void **state)
{
    (void)state;
    fixture with;
    fixture_create(&with);
    fm_plan_request request = { .methods = LIST("kb"),
                                .devices = LIST("tbr", "vulkan"),
                                .feeds = LIST("frames", "raster") };
    expect(&with, &request, 4);
    assert_int_equal(with.plan.launches, 5);
    for (size_t i = 0; i < with.plan.count; i++)
        assert_int_equal(plan_case_launches(&with.plan, i),
                         strcmp(with.plan.cases[i].feed, "frames") == 0 ? 1 : 5);
    request.feeds = LIST("frames");
    expect(&with, &request, 2);
    assert_int_equal(with.plan.launches, 1);
    request.axes = LIST("launches=3");
    expect(&with, &request, 2);
    assert_int_equal(plan_case_launches(&with.plan, 0), 3);
    plan_free(&with.plan);
}

static void plan_expands_lists_and_ranges(void **state)
{
    (void)state;
    static const struct {
        const char *axis;
        size_t count;
        uint32_t last;
    } good[] = {
        { "k=4,8,16", 3, 16 },  { "k=4:64:*2", 5, 64 }, { "k=4:63:*2", 4, 32 },
        { "k=4:16:+4", 4, 16 }, { "k=7:7:+1", 1, 7 },   { "k=1,4:8:+2,8,08", 4, 8 },
        { "k=4,4", 1, 4 },
    };
    fixture with;
    fixture_create(&with);
    for (size_t i = 0; i < sizeof good / sizeof good[0]; i++) {
        const fm_plan_request request = { .methods = LIST("kb"), .axes = LIST(good[i].axis) };
        expect(&with, &request, good[i].count);
        assert_int_equal(with.plan.cases[good[i].count - 1].settings.k, good[i].last);
    }
    const fm_plan_request reals = { .methods = LIST("ab"),
                                    .axes = LIST("alpha=0.1:0.3:+0.1", "n=4") };
    expect(&with, &reals, 3);
    assert_true(with.plan.cases[2].settings.alpha >= 0.3);
    assert_true(with.plan.cases[2].settings.alpha <= 0.3);
    plan_free(&with.plan);
}

static void plan_crosses_axes_with_the_last_one_fastest(void **state)
{
    (void)state;
    fixture with;
    fixture_create(&with);
    const fm_plan_request request = { .methods = LIST("kb"),
                                      .devices = LIST("vulkan:1", "dummy"),
                                      .feeds = LIST("raster", "compute-layer"),
                                      .axes = LIST("k=4,8", "seed=1,2") };
    expect(&with, &request, 16);
    assert_string_equal(with.plan.cases[0].device, "vulkan:1");
    assert_string_equal(with.plan.cases[4].feed, "compute-layer");
    assert_string_equal(with.plan.cases[8].device, "dummy");
    assert_int_equal(with.plan.cases[1].settings.seed, 2);
    assert_int_equal(with.plan.cases[2].settings.k, 8);
    plan_free(&with.plan);
}

static void plan_refuses_axes_with_the_nearest_name(void **state)
{
    (void)state;
    static const struct {
        const char *axis, *message;
    } bad[] = {
        { "k", "-a k: not KEY=VALUES" },
        { "=4", "not KEY=VALUES" },
        { "k=", "an empty value" },
        { "k=4,,8", "an empty value" },
        { "k=0", "-a k=0: k: '0' is not a legal value; legal: 1..4096" },
        { "k=4x", "'4x'" },
        { "k=4:8", "no step" },
        { "k=4:8:2", "no step" },
        { "k=4:x:*2", "not three numbers" },
        { "k=8:4:*2", "LOW is above HIGH" },
        { "k=4:8:*1", "it would never end" },
        { "k=4:8:+0", "it would never end" },
        { "seed=0:8:*2", "it would never end" },
        { "seed=0:18446744073709551615:+1", "more than 10000 values" },
        { "alpha=0.5:1:+1e-300", "is too small" },
        { "tesselation=4", "the nearest is 'tessellation'" },
        { "layot=pixel", "the nearest is 'layout'" },
        { "layout=pixle", "'pixle' is not a legal value; legal: " },
        { "order=randm", "legal: random|" },
        { "timers=pass", "timers: 'pass' is not a legal value; legal: passes|frame" },
        { "launches=3,5", "one value a run" },
        { "zoom=2", "no chosen scene reads 'zoom'" },
        { "device=vulcan", "no device 'vulcan'; the nearest is 'vulkan'" },
        { "feed=rastr", "no feed 'rastr'; the nearest is 'raster'" },
        { "method=kbb", "kb" },
        { "scene=layer", "no scene 'layer'; the nearest is 'layers'" },
        { "scene=/nowhere/a.yml", "/nowhere/a.yml" },
        { "n=70000", "0..65536" },
        { "r=65536", "is above 65536" },
    };
    fixture with;
    fixture_create(&with);
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        const fm_plan_request request = { .methods = LIST("kb", "ab"), .axes = LIST(bad[i].axis) };
        const fm_status status = expand(&with, &request);
        assert_true(status == FM_INVALID || status == FM_IO);
        if (strstr(with.err.message, bad[i].message) == NULL)
            fail_msg("%s: '%s' lacks '%s'", bad[i].axis, with.err.message, bad[i].message);
    }
    expect_refused(&with, &(fm_plan_request){ .axes = LIST("k=4", "k=8") }, "'k' is given twice");
    expect_refused(&with, &(fm_plan_request){ .axes = LIST("n=4", "r=8") }, "n and r");
}

static void plan_bounds_the_number_of_cases(void **state)
{
    (void)state;
    fixture with;
    fixture_create(&with);
    const fm_plan_request request = { .methods = LIST("kb"),
                                      .axes = LIST("seed=1:1000:+1", "k=1:101:+1", "n=9") };
    expect_refused(&with, &request, "more than 100000 cases");
    expect_axis_refused(&with, "seed=0:9999999:+1", "more than 10000 values");
}

static void plan_joins_cases_that_differ_only_in_an_unused_k(void **state)
{
    (void)state;
    fixture with;
    fixture_create(&with);
    const fm_plan_request given = { .methods = LIST("ab"), .axes = LIST("k=4,8,16", "n=32") };
    expect(&with, &given, 1);
    assert_int_equal(with.plan.cases[0].settings.k, 0);
    assert_int_equal(with.plan.cases[0].settings.n, 32);
    const fm_plan_request computed = { .methods = LIST("ab"), .axes = LIST("k=4,8", "r=2,4") };
    expect(&with, &computed, 3); /* n = 8, 16, 32 */
    const fm_plan_request locked = { .methods = LIST("ab", "kb"),
                                     .axes = LIST("lock=spin,interlock") };
    expect(&with, &locked, 3);
    plan_free(&with.plan);
}

static void plan_gives_an_option_to_the_methods_that_have_it(void **state)
{
    (void)state;
    fixture with;
    fixture_create(&with);
    const fm_plan_request request = { .methods = LIST("kb", "ab"), .axes = LIST("page=1:4:*2") };
    expect(&with, &request, 4);
    assert_int_equal(with.plan.cases[0].choice_count, 1); /* its own, as the descriptor has it */
    assert_string_equal(with.plan.cases[0].choices[0].value, "pixel");
    const fm_case *last = &with.plan.cases[3];
    assert_string_equal(last->choices[last->choice_count - 1].name, "page");
    assert_string_equal(last->choices[last->choice_count - 1].value, "4");
    plan_free(&with.plan);
}

static void plan_skips_with_the_reason(void **state)
{
    (void)state;
    fixture with;
    fixture_create(&with);
    expect(&with, &(fm_plan_request){ .methods = LIST("kb"), .axes = LIST("k=32,64") }, 2);
    assert_null(with.plan.cases[0].skip);
    assert_string_equal(with.plan.cases[1].skip, "k = 64: the method's largest is 32");
    assert_int_equal(with.plan.cases[1].skip_status, FM_CASE_NOT_SUPPORTED);
    assert_int_equal(with.plan.cases[0].skip_reason, FM_REASON_NONE);
    assert_int_equal(with.plan.cases[1].skip_reason, FM_REASON_SETTING);
    expect(&with, &(fm_plan_request){ .methods = LIST("ab"), .feeds = LIST("triangles") }, 1);
    assert_string_equal(with.plan.cases[0].skip, "feed 'triangles': the method takes raster");
    assert_int_equal(with.plan.cases[0].skip_reason, FM_REASON_FEED);
    expect(&with,
           &(fm_plan_request){
               .methods = LIST("kb"), .devices = LIST("tbr"), .feeds = LIST("raster") },
           1);
    assert_string_equal(with.plan.cases[0].skip, "feed 'raster': device tbr does not take it");
    assert_int_equal(with.plan.cases[0].skip_reason, FM_REASON_FEED);
    expect(&with, &(fm_plan_request){ .methods = LIST("ab", "kb"), .axes = LIST("layout=layer") },
           2);
    assert_string_equal(with.plan.cases[0].skip, "layout = layer: the method has pixel, tile");
    assert_int_equal(with.plan.cases[0].skip_reason, FM_REASON_SETTING);
    assert_null(with.plan.cases[1].skip);
    expect(&with,
           &(fm_plan_request){ .methods = LIST("kb"),
                               .axes = LIST("generator=mesh", "mesh=/nowhere/a.obj") },
           1);
    assert_memory_equal(with.plan.cases[0].skip, "mesh: /nowhere/a.obj: ", 22);
    assert_int_equal(with.plan.cases[0].skip_reason, FM_REASON_SCENE);
    plan_free(&with.plan);
}

static void plan_skips_what_cannot_be_culled(void **state)
{
    (void)state;
    fixture with;
    fixture_create(&with);
    expect(&with,
           &(fm_plan_request){ .methods = LIST("ab", "kb"), .axes = LIST("culling=occupancy") }, 2);
    assert_string_equal(with.plan.cases[0].skip,
                        "culling = occupancy: the method keeps other fragments than the k nearest");
    assert_int_equal(with.plan.cases[0].skip_reason, FM_REASON_SETTING);
    assert_null(with.plan.cases[1].skip);
    plan_free(&with.plan);
}

/* Without a map its size changes nothing: one case, of the id that it had without such keys. */
static void keys_of_a_map_that_is_not_there_are_forgotten(void **state)
{
    (void)state;
    char first[17];
    fixture with;
    fixture_create(&with);
    expect(&with, &(fm_plan_request){ .methods = LIST("kb") }, 1);
    strcpy(first, with.plan.cases[0].id);
    expect(&with,
           &(fm_plan_request){ .methods = LIST("kb"),
                               .axes = LIST("culling=none,occupancy", "cull_words=1,2") },
           3);
    assert_string_equal(with.plan.cases[0].id, first);
    assert_int_equal(with.plan.cases[0].settings.cull_words, 32);
    assert_int_equal(with.plan.cases[1].settings.cull_words, 1);
    plan_free(&with.plan);
}

static void simulated_passes_have_no_timers(void **state)
{
    (void)state;
    static const fm_technique technique = { 0 };
    const fm_method_desc simulated = { .id = "ab", .version = "1", .technique = &technique };
    fixture with;
    fixture_create(&with);
    with.plugins[0].method = &simulated;
    expect(&with, &(fm_plan_request){ .methods = LIST("ab"), .axes = LIST("timers=passes,frame") },
           1);
    plan_free(&with.plan);
}

/* A spec in a folder of its own, beside a scene "s.yml". */
typedef struct spec_folder {
    char folder[64], spec[96], scene[96];
} spec_folder;

static void spec_create(spec_folder *at, const char *spec, const char *scene)
{
    fm_error err;
    strcpy(at->folder, "/tmp/fragmark-plan-XXXXXX");
    assert_non_null(mkdtemp(at->folder));
    snprintf(at->spec, sizeof at->spec, "%s/spec.yml", at->folder);
    snprintf(at->scene, sizeof at->scene, "%s/s.yml", at->folder);
    assert_int_equal(text_write_file(at->spec, spec, strlen(spec), &err), FM_OK);
    assert_int_equal(text_write_file(at->scene, scene, strlen(scene), &err), FM_OK);
}

static void spec_destroy(const spec_folder *at)
{
    unlink(at->spec);
    unlink(at->scene);
    rmdir(at->folder);
}

static void plan_reads_specs_and_lets_the_command_line_win(void **state)
{
    (void)state;
    fixture with;
    spec_folder at;
    fixture_create(&with);
    spec_create(&at,
                "methods: [kb, ab]\nscenes: s.yml\ndevices:\n  - dummy\nk: [4, 8]\nr: 2\n"
                "layout: [pixel, layer]\nlaunches: 3\nseed: 9\n",
                "generator: layers\nn: 5\norder: descending\n");
    const fm_plan_request spec = { .spec = at.spec };
    /* kb: 2 k x 2 layouts; ab: 2 n x 2 layouts */
    expect(&with, &spec, 8);
    assert_string_equal(with.plan.cases[0].scene, at.scene);
    assert_string_equal(with.plan.cases[0].device, "dummy");
    assert_int_equal(with.plan.cases[0].settings.n, 8);
    assert_int_equal(with.plan.cases[0].settings.order, FM_ORDER_DESCENDING);
    assert_int_equal(with.plan.launches, 3);
    assert_int_equal(with.plan.seed, 9);
    const fm_plan_request both = { .spec = at.spec,
                                   .methods = LIST("kb"),
                                   .devices = LIST("dummy"),
                                   .axes = LIST("n=20", "layout=layer", "order=ascending") };
    expect(&with, &both, 2);
    assert_string_equal(with.plan.cases[0].device, "dummy");
    assert_int_equal(with.plan.cases[1].settings.n, 20);
    assert_int_equal(with.plan.cases[1].settings.r, 0);
    assert_int_equal(with.plan.cases[1].settings.order, FM_ORDER_ASCENDING);
    spec_destroy(&at);
    plan_free(&with.plan);
}

static void plan_refuses_specs_with_the_line(void **state)
{
    (void)state;
    static const struct {
        const char *spec, *message;
    } bad[] = {
        { "methods: [kb]\ntesselation: 4\n", "spec.yml:2: no key or option of a chosen method "
                                             "'tesselation'; the nearest is 'tessellation'" },
        { "methds: [kb]\n", "spec.yml:1: no key or option of a chosen method 'methds'; the nearest "
                            "is 'methods'" },
        { "methods:\n  - kb\n  - kc\n", "spec.yml:3: " },
        { "devices: [dumy]\n", "spec.yml:1: no device 'dumy'; the nearest is 'dummy'" },
        { "k: [4, 0]\n", "spec.yml:1: k: '0'" },
        { "k: {a: 1}\n", "spec.yml:1: k: not a value" },
        { "k: []\n", "spec.yml:1: 'k' has no value" },
        { "methods: {kb: 1}\n", "spec.yml:1: methods: not a list" },
        { "n: 4\nr: 2\n", "spec.yml:2: n and r" },
        { "k: 4\nk: 8\n", "spec.yml:2: 'k' stands on line 1" },
        { "- kb\n", "spec.yml:1: not 'key: value'" },
        { "layout: pixl\n", "spec.yml:1: 'pixl' is not a legal value; legal: " },
    };
    fixture with;
    fixture_create(&with);
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        spec_folder at;
        spec_create(&at, bad[i].spec, "generator: layers\n");
        expect_refused(&with, &(fm_plan_request){ .spec = at.spec }, bad[i].message);
        spec_destroy(&at);
    }
    assert_int_equal(expand(&with, &(fm_plan_request){ .spec = "/nowhere/a.yml" }), FM_IO);
}

static void plan_keeps_keys_from_scenes_that_do_not_read_them(void **state)
{
    (void)state;
    fixture with;
    spec_folder at;
    fixture_create(&with);
    spec_create(&at,
                "scenes: [layers, s.yml]\nmethods: kb\npixel_density: [0.5, 1]\nr: [2, 4]\n"
                "mesh: [spec.yml, none.obj, s.yml]\n",
                "generator: mesh\nmesh: spec.yml\n"); /* any file has a digest */
    expect(&with, &(fm_plan_request){ .spec = at.spec }, 7);
    assert_int_equal(with.plan.cases[4].settings.n, 0);
    for (size_t i = 4; i < 7; i++) /* only the case of the missing file is skipped */
        assert_int_equal(with.plan.cases[i].skip != NULL, i == 5);
    assert_string_equal(with.plan.cases[4].settings.mesh, at.spec);
    spec_destroy(&at);
    plan_free(&with.plan);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(plan_of_nothing_is_every_method_but_controls),
        cmocka_unit_test(plan_tells_a_refused_method_that_is_named),
        cmocka_unit_test(plan_launches_simulated_cases_once),
        cmocka_unit_test(plan_expands_lists_and_ranges),
        cmocka_unit_test(plan_crosses_axes_with_the_last_one_fastest),
        cmocka_unit_test(plan_refuses_axes_with_the_nearest_name),
        cmocka_unit_test(plan_bounds_the_number_of_cases),
        cmocka_unit_test(plan_joins_cases_that_differ_only_in_an_unused_k),
        cmocka_unit_test(plan_gives_an_option_to_the_methods_that_have_it),
        cmocka_unit_test(plan_skips_with_the_reason),
        cmocka_unit_test(plan_skips_what_cannot_be_culled),
        cmocka_unit_test(keys_of_a_map_that_is_not_there_are_forgotten),
        cmocka_unit_test(simulated_passes_have_no_timers),
        cmocka_unit_test(plan_reads_specs_and_lets_the_command_line_win),
        cmocka_unit_test(plan_refuses_specs_with_the_line),
        cmocka_unit_test(plan_keeps_keys_from_scenes_that_do_not_read_them),
    };
    return cmocka_run_group_tests_name("plan", tests, NULL, NULL);
}
