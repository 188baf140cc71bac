/* What an `after` hook answers, and what it does to what it is shown, is checked. */
#include "kit/frame_kit.h"

static const kit_file files[] = { { "one.glsl",
                                    "void one(uvec2 pixel)\n{\n    if (pixel == uvec2(0u))\n"
                                    "        result[0] += 1u;\n}\n" } };

static fm_next answers_nonsense(const fm_workload *workload, const char *pass)
{
    static const unsigned nonsense = 12345;
    fm_next next;
    (void)workload;
    (void)pass;
    memcpy(&next, &nonsense, sizeof next);
    return next;
}

static fm_next repeats(const fm_workload *workload, const char *pass)
{
    (void)workload;
    (void)pass;
    return FM_REPEAT;
}

/* What no hook may do, and C lets it do. */
static void overwrite(const uint64_t *constant, uint64_t value)
{
    uint64_t *written;
    memcpy(&written, &constant, sizeof written);
    *written = value;
}

static fm_next writes_totals(const fm_workload *workload, const char *pass)
{
    (void)pass;
    overwrite(&workload->totals[0], 1u << 30);
    return FM_NEXT;
}

static fm_next writes_fragments(const fm_workload *workload, const char *pass)
{
    (void)pass;
    overwrite(&workload->fragments, 400000000);
    return FM_NEXT;
}

static fm_next asks_for_options(const fm_workload *workload, const char *pass)
{
    (void)pass;
    assert_null(workload->option(workload, "colour"));
    assert_string_equal(workload->option(workload, "page"), "2");
    assert_int_equal(workload->totals[0], 1);
    return FM_NEXT;
}

static fm_method_desc method_with(fm_next (*after)(const fm_workload *, const char *))
{
    return (fm_method_desc){
        .id = "hooked",
        .traits = FM_TRAIT_FLOOR,
        .options = { { .name = "page", .values = { "2", "4" } } },
        .resources = { { .name = "result", .extent = { .constant = 1 } } },
        .totals = { { .name = "sum", .resource = "result", .pass = "one" } },
        .passes = { { .name = "clear", .kind = FM_PASS_CLEAR, .writes = { "result" } },
                    { .name = "one",
                      .kind = FM_PASS_PIXELS,
                      .shader = "one.glsl",
                      .writes = { "result" } },
                    { .name = "ask", .kind = FM_PASS_HOST } },
        .after = after,
    };
}

static fm_status try_frame(frames_seen *seen, fm_device *device, const fm_method_desc *method,
                           fm_error *err)
{
    const kit_frames frames = { .method = method, .files = files, .file_count = 1 };
    return frames_try(seen, device, &frames, err);
}

static void expect_refused(fm_device *device, const fm_method_desc *method, const char *message)
{
    frames_seen seen;
    fm_error err = { 0 };
    assert_int_equal(try_frame(&seen, device, method, &err), FM_INVALID);
    assert_string_equal(err.message, message);
}

static void an_answer_that_is_none_is_refused(void **state)
{
    const fm_method_desc method = method_with(answers_nonsense);
    expect_refused(*state, &method, "hooked: pass 'ask': after: answered 12345, no fm_next");
}

static void repeating_outside_of_a_loop_is_refused(void **state)
{
    const fm_method_desc method = method_with(repeats);
    expect_refused(*state, &method,
                   "hooked: pass 'ask': after: answered FM_REPEAT (1), and no loop holds the pass");
}

static void repeating_beyond_the_last_iteration_is_refused(void **state)
{
    fm_method_desc method = method_with(repeats);
    method.loops[0] = (fm_loop){ .first = "one", .last = "ask", .max = 7 };
    expect_refused(*state, &method,
                   "hooked: loop 'one': after: answered FM_REPEAT (1) in iteration 7, the last");
}

static void a_hook_that_writes_to_what_it_is_shown_is_refused(void **state)
{
    fm_method_desc method = method_with(writes_totals);
    expect_refused(*state, &method,
                   "hooked: pass 'ask': after: wrote to the workload, which is constant");
    method.after = writes_fragments;
    expect_refused(*state, &method,
                   "hooked: pass 'ask': after: wrote to the workload, which is constant");
}

static void a_hook_is_shown_totals_and_options(void **state)
{
    frames_seen seen;
    fm_error err = { 0 };
    const fm_method_desc method = method_with(asks_for_options);
    if (try_frame(&seen, *state, &method, &err) != FM_OK)
        fail_msg("%s", err.message);
    assert_int_equal(seen.result, 1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        ON_VULKAN_AND_OSMESA(an_answer_that_is_none_is_refused),
        ON_VULKAN_AND_OSMESA(repeating_outside_of_a_loop_is_refused),
        ON_VULKAN_AND_OSMESA(repeating_beyond_the_last_iteration_is_refused),
        ON_VULKAN_AND_OSMESA(a_hook_that_writes_to_what_it_is_shown_is_refused),
        ON_VULKAN_AND_OSMESA(a_hook_is_shown_totals_and_options),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
