/* Loops, ping-pong copies and includes, as descriptors use them, on shaders written by the test. */
#include <stdio.h>

#include "kit/frame_kit.h"

#define HEAD .id = "looped", .traits = FM_TRAIT_FLOOR

/* The empty line before the include is part of the test. */
static const char add_one[] =
    "\n#include \"result.glsl\"\nvoid one(uvec2 pixel) { add(pixel, 1u); }\n";
static const char add_hundred[] =
    "#include \"result.glsl\"\nvoid hundred(uvec2 pixel) { add(pixel, 100u); }\n";
static const char result_file[] = "void add(uvec2 pixel, uint term)\n{\n"
                                  "    if (pixel == uvec2(0u))\n        result[0] += term;\n}\n";
static const char step_file[] =
    "void step_on(uvec2 pixel)\n{\n    uint i = fm_pixel_index(pixel);\n"
    "    value[i] = fm_iteration == 0u ? 1u : value_previous[i] + 1u;\n}\n";
static const char take_file[] = "void take(uvec2 pixel)\n{\n    if (pixel == uvec2(0u))\n"
                                "        result[0] = value_previous[0];\n}\n";
static const char vote_file[] =
    "void vote(uvec2 pixel)\n{\n    uint votes = subgroupBallotBitCount(subgroupBallot(true));\n"
    "    if (pixel == uvec2(0u) && votes > 0u)\n        result[0] = 7u;\n}\n";
static const char wide_file[] =
    "void wide(uvec2 pixel)\n{\n    uint64_t sum = uint64_t(pixel.x) + 1ul;\n"
    "    if (pixel == uvec2(0u))\n        result[0] = uint(sum >> 1);\n}\n";

static const char more_file[] = "void more(uvec2 pixel)\n{\n    if (pixel == uvec2(0u))\n"
                                "        result[0] = result[0] == 0u ? 1u : 6u;\n"
                                "}\n";
static const char number_file[] =
    "void number(uvec2 pixel)\n{\n    uint i = fm_pixel_index(pixel);\n"
    "    if (i < fm_length_many)\n        many[i] = i;\n}\n";

static const kit_file files[] = { { "one.glsl", add_one },        { "hundred.glsl", add_hundred },
                                  { "result.glsl", result_file }, { "step.glsl", step_file },
                                  { "take.glsl", take_file },     { "vote.glsl", vote_file },
                                  { "wide.glsl", wide_file },     { "more.glsl", more_file },
                                  { "number.glsl", number_file } };

static kit_frames frames_of(const fm_method_desc *method)
{
    return (kit_frames){ .method = method,
                         .files = files,
                         .file_count = sizeof files / sizeof files[0] };
}

static uint32_t run_frame(fm_device *device, const fm_method_desc *method, fm_buffers buffers)
{
    kit_frames frames = frames_of(method);
    frames.buffers = buffers;
    return frames_run(device, &frames);
}

static fm_status try_frame(fm_device *device, const fm_method_desc *method, fm_error *err)
{
    frames_seen ignored;
    const kit_frames frames = frames_of(method);
    return frames_try(&ignored, device, &frames, err);
}

static fm_next until_three(const fm_workload *workload, const char *pass)
{
    assert_string_equal(pass, "ask");
    return workload->totals[0] < 3 ? FM_REPEAT : FM_NEXT;
}

static void loop_without_count_runs_until_the_hook_lets_go(void **state)
{
    static const fm_method_desc method = {
        HEAD,
        .resources = { { .name = "result", .extent = { .constant = 1 } } },
        .totals = { { .name = "sum", .resource = "result", .pass = "one" } },
        .passes = { { .name = "clear", .kind = FM_PASS_CLEAR, .writes = { "result" } },
                    { .name = "one",
                      .kind = FM_PASS_PIXELS,
                      .shader = "one.glsl",
                      .writes = { "result" } },
                    { .name = "ask", .kind = FM_PASS_HOST } },
        .loops = { { .first = "one", .last = "ask" } },
        .after = until_three,
    };
    assert_int_equal(run_frame(*state, &method, FM_BUFFERS_AUTO), 3);
}

static void loops_that_start_together_nest(void **state)
{
    static const fm_method_desc method = {
        HEAD,
        .resources = { { .name = "result", .extent = { .constant = 1 } } },
        .passes = { { .name = "clear", .kind = FM_PASS_CLEAR, .writes = { "result" } },
                    { .name = "one",
                      .kind = FM_PASS_PIXELS,
                      .shader = "one.glsl",
                      .writes = { "result" } },
                    { .name = "hundred",
                      .kind = FM_PASS_PIXELS,
                      .shader = "hundred.glsl",
                      .writes = { "result" } } },
        .loops = { { .first = "one", .last = "one", .count = 3 },
                   { .first = "one", .last = "hundred", .count = 2 } },
    };
    assert_int_equal(run_frame(*state, &method, FM_BUFFERS_AUTO), 2 * (3 * 1 + 100));
}

/* The hook sees 1 in the first frame and asks for another one, which finds 6. */
static fm_next until_six(const fm_workload *workload, const char *pass)
{
    assert_string_equal(pass, "ask");
    return workload->totals[0] == 6 ? FM_NEXT : FM_REDO;
}

static void a_hook_may_ask_for_the_frame_again(void **state)
{
    static const fm_method_desc method = {
        HEAD,
        .resources = { { .name = "result", .extent = { .constant = 1 } } },
        .totals = { { .name = "sum", .resource = "result", .pass = "more" } },
        .passes = { { .name = "more",
                      .kind = FM_PASS_PIXELS,
                      .shader = "more.glsl",
                      .writes = { "result" } },
                    { .name = "ask", .kind = FM_PASS_HOST } },
        .after = until_six,
    };
    frames_seen seen;
    fm_error err = { 0 };
    const kit_frames frames = frames_of(&method);
    assert_int_equal(frames_try(&seen, *state, &frames, &err), FM_OK);
    assert_int_equal(seen.redos, 1);
    assert_int_equal(seen.result, 6);
}

/* A hook that is never content is stopped, and told of. */
static fm_next again(const fm_workload *workload, const char *pass)
{
    (void)workload;
    (void)pass;
    return FM_REDO;
}

static void a_hook_that_asks_for_ever_is_refused(void **state)
{
    static const fm_method_desc method = {
        HEAD,
        .resources = { { .name = "result", .extent = { .constant = 1 } } },
        .passes = { { .name = "ask", .kind = FM_PASS_HOST } },
        .after = again,
    };
    fm_error err = { 0 };
    assert_int_equal(try_frame(*state, &method, &err), FM_INVALID);
    assert_non_null(strstr(err.message, "looped: asked for the frame again"));
}

static void a_loop_may_count_the_fragments_of_a_pixel(void **state)
{
    static const fm_method_desc method = {
        HEAD,
        .resources = { { .name = "result", .extent = { .constant = 1 } } },
        .passes = { { .name = "clear", .kind = FM_PASS_CLEAR, .writes = { "result" } },
                    { .name = "one",
                      .kind = FM_PASS_PIXELS,
                      .shader = "one.glsl",
                      .writes = { "result" } } },
        .loops = { { .first = "one", .last = "one", .count = 1, .count_per_n = 2 } },
    };
    kit_frames frames = frames_of(&method);
    frames.scene = "width_px=3 height_px=2 n=5 pixel_density=1";
    assert_int_equal(frames_run(*state, &frames), 1 + 2 * 5);
}

static const fm_method_desc ping_pong = {
    HEAD,
    .resources = { { .name = "result", .extent = { .constant = 1 } },
                   { .name = "value", .extent = { .per_pixel = 1 }, .ping_pong = true } },
    .passes = { { .name = "step-on",
                  .kind = FM_PASS_PIXELS,
                  .shader = "step.glsl",
                  .reads = { "value_previous" },
                  .writes = { "value" } },
                { .name = "take",
                  .kind = FM_PASS_PIXELS,
                  .shader = "take.glsl",
                  .reads = { "value_previous" },
                  .writes = { "result" } } },
    .loops = { { .first = "step-on", .last = "step-on", .count = 5 } },
};

static void an_iteration_reads_what_the_last_one_wrote(void **state)
{
    assert_int_equal(run_frame(*state, &ping_pong, FM_BUFFERS_BOUND), 5);
}

static void an_iteration_reads_what_the_last_one_wrote_by_address(void **state)
{
    const fm_device *device = *state;
    if ((device->caps.features & FM_FEATURE_BUFFER_ADDRESS) == 0)
        skip();
    assert_int_equal(run_frame(*state, &ping_pong, FM_BUFFERS_ADDRESS), 5);
}

/* One pixel pass of this name writes result[0]. */
static fm_method_desc one_pass(const char *name, const char *shader, uint32_t features)
{
    return (fm_method_desc){
        HEAD,
        .features = features,
        .resources = { { .name = "result", .extent = { .constant = 1 } } },
        .passes = { { .name = name,
                      .kind = FM_PASS_PIXELS,
                      .shader = shader,
                      .writes = { "result" } } },
    };
}

static void a_method_that_asks_for_ballots_has_their_words(void **state)
{
    const fm_device *device = *state;
    const fm_method_desc method = one_pass("vote", "vote.glsl", FM_FEATURE_SUBGROUP_BALLOT);
    if ((device->caps.features & FM_FEATURE_SUBGROUP_BALLOT) == 0)
        skip();
    assert_int_equal(run_frame(*state, &method, FM_BUFFERS_AUTO), 7);
}

static void a_feature_that_the_device_lacks_is_the_reason(void **state)
{
    fm_device *device = *state;
    fm_error err = { 0 };
    const uint32_t features = device->caps.features;
    const fm_method_desc method = one_pass("vote", "vote.glsl", FM_FEATURE_SUBGROUP_BALLOT);
    device->caps.features = features & ~(uint32_t)FM_FEATURE_SUBGROUP_BALLOT;
    const fm_status status = try_frame(device, &method, &err);
    device->caps.features = features;
    assert_int_equal(status, FM_UNSUPPORTED);
    assert_int_equal(err.reason, FM_REASON_FEATURE);
    assert_non_null(strstr(err.message, "needs subgroup ballots, which"));
}

static void only_a_method_that_asks_for_64_bits_has_them(void **state)
{
    fm_error err = { 0 };
    const fm_method_desc method = one_pass("wide", "wide.glsl", 0);
    assert_int_equal(try_frame(*state, &method, &err), FM_SHADER);
    assert_non_null(strstr(err.message, "uint64_t"));
}

/* 3 x 2 pixels: wrapped to 64 bits these would be 2 and 12 bytes. */
static void an_extent_beyond_64_bits_is_no_memory(void **state)
{
    static const fm_extent extents[] = { { .per_pixel = (UINT64_C(1) << 63) / 3 + 1 },
                                         { .constant = UINT64_MAX, .per_pixel = 1 } };
    for (size_t i = 0; i < sizeof extents / sizeof extents[0]; i++) {
        fm_error err = { 0 };
        fm_method_desc method = ping_pong;
        method.resources[1].extent = extents[i];
        assert_int_equal(try_frame(*state, &method, &err), FM_NO_MEMORY);
        assert_non_null(strstr(err.message, "'value'"));
    }
}

/* The first frame waits for the total, which is 1; the second one goes on with what that sized,
 * finds at its end that the total has become 6, and is run again. */
static void a_late_total_runs_the_frame_again_that_it_had_no_room_in(void **state)
{
    static const fm_method_desc method = {
        HEAD,
        .resources = { { .name = "result", .extent = { .constant = 1 } },
                       { .name = "many",
                         .sizing = FM_SIZE_AFTER_TOTAL,
                         .extent = { .per_total = 1, .total = "sum" } } },
        .totals = { { .name = "sum", .resource = "result", .pass = "more", .late = true } },
        .passes = { { .name = "more",
                      .kind = FM_PASS_PIXELS,
                      .shader = "more.glsl",
                      .writes = { "result" } },
                    { .name = "number",
                      .kind = FM_PASS_PIXELS,
                      .shader = "number.glsl",
                      .writes = { "many" } } },
    };
    static const frames_seen expected[] = { { .length = 1 },
                                            { .redos = 1, .length = 6, .last = 5 },
                                            { .length = 6, .last = 5 } };
    for (int i = 0; i < 3; i++) {
        fm_error err = { 0 };
        frames_seen seen;
        kit_frames frames = frames_of(&method);
        frames.frames = i + 1;
        assert_int_equal(frames_try(&seen, *state, &frames, &err), FM_OK);
        assert_int_equal(seen.redos, expected[i].redos);
        assert_int_equal(seen.length, expected[i].length);
        assert_int_equal(seen.last, expected[i].last);
    }
}

static void expect_redone(kit_scene *scene, const char *method, const char *texts, uint64_t frames)
{
    fm_measurement m;
    assert_true(kit_measure(&m, scene, &(kit_way){ method, FM_FEED_RASTER, texts }));
    assert_int_equal(m.frames_redone, frames);
    assert_int_equal(m.redone_ns > 0, frames > 0);
    measurement_free(&m);
}

/* A list's pool starts too small: the first frame of the timed build and that of the checked one
 * are thrown away, and what they cost is told. An array of n never grows. */
static void frames_thrown_away_are_counted_and_timed(void **state)
{
    scene_kit kit;
    kit_scene scene;
    kit_open(&kit, device_of(state));
    kit_scene_open(&scene, &kit, "width_px=16 height_px=16 n=9 pixel_density=1");
    expect_redone(&scene, "ab-ll", "node=split", 2);
    expect_redone(&scene, "ab-ll", "node=whole", 2);
    expect_redone(&scene, "ab-array", "", 0);
    kit_scene_close(&scene);
    kit_close(&kit);
}

static void expect_one_timer(kit_scene *scene, const kit_way *way)
{
    const fm_sample none = { 0 };
    char texts[64];
    fm_measurement each, one;
    snprintf(texts, sizeof texts, "%s timers=frame", way->texts);
    assert_true(kit_measure(&each, scene, way));
    assert_true(kit_measure(&one, scene, &(kit_way){ way->method, way->feed, texts }));
    const fm_sample *sample = &one.samples[0];
    assert_true(sample->frame_ns > 0 && sample->floor_frame_ns > 0 && sample->canary_ns > 0);
    assert_memory_equal(sample->pass_ns, none.pass_ns, sizeof none.pass_ns);
    assert_int_equal(sample->floor_store_ns, 0);
    assert_int_equal(one.redone_ns > 0, each.redone_ns > 0);
    assert_true(kit_apart(each.image, one.image) == 0.0);
    assert_memory_equal(&one.check, &each.check, sizeof one.check);
    assert_int_equal(one.scene_passes, each.scene_passes);
    measurement_free(&each);
    measurement_free(&one);
}

/* Passes that follow each other, a loop, a total that parts the frame, a frame done again, an image
 * that is combined from front and back, a map before the passes. */
static void one_timer_for_a_frame_changes_its_times_only(void **state)
{
    static const kit_way ways[] = {
        { "kplus-array", FM_FEED_RASTER, "k=4" },
        { "kb-multi", FM_FEED_RASTER, "k=4" },
        { "s-buffer", FM_FEED_COMPUTE_PIXEL, "" },
        { "ab-ll", FM_FEED_RASTER, "" },
        { "dual", FM_FEED_RASTER, "" },
        { "kplus-array", FM_FEED_RASTER, "k=4 culling=occupancy" },
    };
    scene_kit kit;
    kit_scene scene;
    kit_open(&kit, device_of(state));
    kit_scene_open(&scene, &kit, "width_px=16 height_px=16 n=9 pixel_density=1");
    for (size_t i = 0; i < sizeof ways / sizeof ways[0]; i++)
        expect_one_timer(&scene, &ways[i]);
    kit_scene_close(&scene);
    kit_close(&kit);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        ON_VULKAN_AND_OSMESA(loop_without_count_runs_until_the_hook_lets_go),
        ON_VULKAN_AND_OSMESA(loops_that_start_together_nest),
        ON_VULKAN_AND_OSMESA(a_hook_may_ask_for_the_frame_again),
        ON_VULKAN_AND_OSMESA(a_hook_that_asks_for_ever_is_refused),
        ON_VULKAN_AND_OSMESA(a_loop_may_count_the_fragments_of_a_pixel),
        ON_VULKAN_AND_OSMESA(an_iteration_reads_what_the_last_one_wrote),
        ON_VULKAN_AND_OSMESA(an_iteration_reads_what_the_last_one_wrote_by_address),
        ON_VULKAN_AND_OSMESA(a_method_that_asks_for_ballots_has_their_words),
        ON_VULKAN_AND_OSMESA(a_feature_that_the_device_lacks_is_the_reason),
        ON_VULKAN_AND_OSMESA(only_a_method_that_asks_for_64_bits_has_them),
        ON_VULKAN_AND_OSMESA(an_extent_beyond_64_bits_is_no_memory),
        ON_VULKAN_AND_OSMESA(a_late_total_runs_the_frame_again_that_it_had_no_room_in),
        ON_VULKAN_AND_OSMESA(frames_thrown_away_are_counted_and_timed),
        ON_VULKAN_AND_OSMESA(one_timer_for_a_frame_changes_its_times_only),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
