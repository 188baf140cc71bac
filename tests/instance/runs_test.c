/* Passes that go on in further runs where a device would end their loops, and loops of passes that
 * never end, on shaders written by the test. */
#include "kit/frame_kit.h"

#define DEEP    "width_px=2 height_px=1 pixel_density=1 tessellation=1 n=3000 alpha=0.01"
#define SHALLOW "width_px=2 height_px=1 pixel_density=1 tessellation=1 n=20"

/* Four runs: the first in all of them, so that the number of calls is known, the second pixel in
 * one more. `kept` is only read as the descriptor has it. */
static const char resolve_file[] =
    "void resolve(uvec2 pixel)\n{\n"
    "#if FM_RESUMES\n"
    "    if (fm_run == 0u)\n        kept[pixel.x] = 1u;\n    else\n        kept[pixel.x] += "
    "fm_run;\n"
    "    if (fm_run < 3u + pixel.x)\n        fm_go_on();\n"
    "    if (pixel.x == 1u)\n        result[0] = kept[1] * 10u + fm_run;\n"
    "#else\n"
    "    if (pixel.x == 0u)\n        result[0] = 7u + fm_run;\n"
    "#endif\n}\n";
static const char spin_file[] = "void spin(uvec2 pixel)\n{\n    result[0] = 1u;\n}\n";
static const kit_file files[] = { { "resolve.glsl", resolve_file }, { "spin.glsl", spin_file } };

static kit_frames frames_of(const fm_method_desc *method, const char *scene)
{
    return (kit_frames){ .method = method,
                         .files = files,
                         .file_count = sizeof files / sizeof files[0],
                         .scene = scene };
}

static fm_method_desc resuming(fm_resumes resumes)
{
    return (fm_method_desc){
        .id = "resuming",
        .traits = FM_TRAIT_FLOOR,
        .resources = { { .name = "result", .extent = { .constant = 1 } },
                       { .name = "kept", .extent = { .constant = 2 } } },
        .passes = { { .name = "clear", .kind = FM_PASS_CLEAR, .writes = { "result", "kept" } },
                    { .name = "resolve",
                      .kind = FM_PASS_PIXELS,
                      .shader = "resolve.glsl",
                      .reads = { "kept" },
                      .writes = { "result" },
                      .resumes = resumes } },
    };
}

static void a_pass_goes_on_until_no_invocation_calls(void **state)
{
    fm_device *device = device_of(state);
    const fm_method_desc method = resuming(FM_RESUMES_BY_N);
    const kit_frames frames = frames_of(&method, DEEP);
    const uint32_t after_five_runs = (1 + 1 + 2 + 3 + 4) * 10 + 4;
    assert_int_equal(frames_run(device, &frames),
                     device->caps.loop_limit > 0 ? after_five_runs : 7);
}

static void below_its_bound_a_pass_runs_once(void **state)
{
    const fm_method_desc by_n = resuming(FM_RESUMES_BY_N), by_k = resuming(FM_RESUMES_BY_K);
    const kit_frames shallow = frames_of(&by_n, SHALLOW), few = frames_of(&by_k, DEEP);
    assert_int_equal(frames_run(device_of(state), &shallow), 7);
    assert_int_equal(frames_run(device_of(state), &few), 7);
}

static void a_loop_without_an_end_is_refused(void **state)
{
    static const fm_method_desc endless = {
        .id = "endless",
        .traits = FM_TRAIT_FLOOR,
        .resources = { { .name = "result", .extent = { .constant = 1 } } },
        .totals = { { .name = "left", .resource = "result", .pass = "spin" } },
        .passes = { { .name = "spin",
                      .kind = FM_PASS_PIXELS,
                      .shader = "spin.glsl",
                      .writes = { "result" } } },
        .loops = { { .first = "spin", .last = "spin", .until_zero = "left" } },
    };
    fm_method_desc bounded = endless;
    bounded.loops[0].max = 5; /* as the method wants it */
    frames_seen seen;
    fm_error err = { .message = "" };
    const kit_frames frames = frames_of(&endless, NULL), few = frames_of(&bounded, NULL);
    assert_int_equal(frames_try(&seen, device_of(state), &few, &err), FM_OK);
    assert_int_equal(frames_try(&seen, device_of(state), &frames, &err), FM_UNSUPPORTED);
    assert_int_equal(err.reason, FM_REASON_SUITE_LIMIT);
    assert_string_equal(err.message, "endless: total 'left' is still 1 after 65536 iterations");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        ON_VULKAN_AND_OSMESA(a_pass_goes_on_until_no_invocation_calls),
        ON_VULKAN_AND_OSMESA(below_its_bound_a_pass_runs_once),
        /* 65 536 read-backs: on the device where they cost less */
        { "a_loop_without_an_end_is_refused [osmesa]", a_loop_without_an_end_is_refused,
          open_osmesa, close_opened, NULL },
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
