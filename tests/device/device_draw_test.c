/* What every device draws alike: positions, depth, stencil, blending, samples and queries;
 * device_vertex_test.c has vertices, device_image_test.c images. */
#include <math.h>

#include "fetch_kit.h"

static const char fetch_alpha[] =
    FETCH_SOURCE("sampler2D", "floatBitsToUint(texelFetch(image, p, 0).a)");
/* four samples, a byte each */
static const char fetch_samples[] =
    FETCH_SOURCE("sampler2DMS", "uint(texelFetch(image, p, 0).r) | uint(texelFetch(image, p, 1).r) "
                                "<< 8 | uint(texelFetch(image, p, 2).r) << 16 | "
                                "uint(texelFetch(image, p, 3).r) << 24");

static const char instance_fragment_float[] = "#version 450\n"
                                              "layout(location = 0) flat in int instance;\n"
                                              "layout(location = 0) out vec4 target;\n"
                                              "void main() { target = vec4(instance + 1); }\n";

/* Rows 0 to 7 of columns 0 to 3, at depth 0.375, and no target: the shader writes what it got. */
static void device_draws_at_the_pixels_vulkan_says(void **state)
{
    static const char vertex[] =
        "#version 450\n"
        "void main() {\n"
        "  uint i = uint(gl_VertexIndex);\n"
        "  vec2 corner = vec2(i == 1u || i == 3u || i == 4u, i == 2u || i == 4u || i == 5u);\n"
        "  gl_Position = vec4(corner * vec2(0.5, 1.0) - 1.0, 0.375, 1.0);\n"
        "}\n";
    static const char fragment[] =
        "#version 450\n"
        "layout(std430, binding = 0) buffer Seen { uint seen[]; };\n"
        "void main() {\n"
        "  uvec2 p = uvec2(gl_FragCoord.xy);\n"
        "  atomicAdd(seen[p.y * 16u + p.x], floatBitsToUint(gl_FragCoord.z));\n"
        "}\n";
    fm_device *device = device_of(state);
    uint32_t words[PIXELS];
    fm_buffer *seen = make_words(device, PIXELS);
    fm_pipeline *pipeline =
        make_pipeline(device, (fm_pipeline_desc){ .vertex = vertex,
                                                  .fragment = fragment,
                                                  .bindings = { { 0, FM_BINDING_STORAGE } },
                                                  .binding_count = 1 });
    const fm_bind bind = bind_words(0, seen, FM_ACCESS_READ | FM_ACCESS_WRITE);
    begin(device);
    device->ops->fill(device, seen, 0);
    draw(device,
         (fm_draw){ .pipeline = pipeline, .binds = &bind, .bind_count = 1, .vertex_count = 6 }, 1);
    end(device);
    read_words(device, seen, words, PIXELS);
    for (uint32_t i = 0; i < PIXELS; i++) {
        const bool is_inside = i % SIDE_PX < 4 && i / SIDE_PX < 8;
        assert_true(as_float(words[i]) == (is_inside ? 0.375f : 0.0f)); /* once each */
    }
    device->ops->pipeline_destroy(device, pipeline);
    device->ops->buffer_destroy(device, seen);
}

/* Three instances, each nearer than the last; a fourth draw behind them must not show. */
static void device_keeps_the_nearest_by_depth(void **state)
{
    fm_device *device = device_of(state);
    uint32_t words[PIXELS];
    fm_image_resource *target = make_image(device, FM_FORMAT_R32UI, 1);
    fm_image_resource *depth = make_image(device, FM_FORMAT_D32F, 1);
    fm_pipeline *pipeline = make_pipeline(
        device,
        (fm_pipeline_desc){ .fragment = instance_fragment,
                            .targets = { { .format = FM_FORMAT_R32UI } },
                            .target_count = 1,
                            .depth_stencil = FM_FORMAT_D32F,
                            .state = { .depth_test = FM_COMPARE_LESS, .depth_write = true } });
    fm_draw command = { .pipeline = pipeline,
                        .targets = { target },
                        .target_loads = { FM_LOAD_CLEAR },
                        .target_count = 1,
                        .depth_stencil = depth,
                        .depth_stencil_load = FM_LOAD_CLEAR,
                        .clear_depth = 1.0f };
    begin(device);
    draw(device, command, 3);
    command.target_loads[0] = command.depth_stencil_load = FM_LOAD_KEEP;
    draw(device, command, 1);
    end_and_fetch(words, device, target, FETCH_UINT);
    for (uint32_t i = 0; i < PIXELS; i++)
        assert_int_equal(words[i], 12);
    begin(device);
    end_and_fetch(words, device, depth, FETCH_RED);
    assert_true(as_float(words[17]) == 0.25f);
    device->ops->pipeline_destroy(device, pipeline);
    device->ops->image_destroy(device, target);
    device->ops->image_destroy(device, depth);
}

typedef struct blend_case {
    fm_blend blend;
    float red, alpha; /* what is expected of source (0.25, 0.75) over target (0.5, 0.5) */
} blend_case;

static void check_blend(fm_device *device, const blend_case *expected)
{
    static const char fragment[] = "#version 450\n"
                                   "layout(location = 0) out vec4 target;\n"
                                   "void main() { target = vec4(0.25, 0.5, 0.5, 0.75); }\n";
    uint32_t red[PIXELS], alpha[PIXELS];
    fm_image_resource *target = make_image(device, FM_FORMAT_RGBA32F, 1);
    fm_pipeline *pipeline =
        make_pipeline(device, (fm_pipeline_desc){ .fragment = fragment,
                                                  .targets = { { .format = FM_FORMAT_RGBA32F,
                                                                 .blend = expected->blend } },
                                                  .target_count = 1 });
    const fm_draw command = { .pipeline = pipeline,
                              .targets = { target },
                              .target_loads = { FM_LOAD_CLEAR },
                              .target_clears = { { 0.5f, 0.5f, 0.5f, 0.5f } },
                              .target_count = 1 };
    begin(device);
    draw(device, command, 1);
    end_and_fetch(red, device, target, FETCH_RED);
    begin(device);
    end_and_fetch(alpha, device, target, fetch_alpha);
    assert_true(fabsf(as_float(red[99]) - expected->red) < 1e-6f);
    assert_true(fabsf(as_float(alpha[99]) - expected->alpha) < 1e-6f);
    device->ops->pipeline_destroy(device, pipeline);
    device->ops->image_destroy(device, target);
}

static void device_blends_as_the_interface_says(void **state)
{
    static const blend_case cases[] = {
        { FM_BLEND_OFF, 0.25f, 0.75f },
        { FM_BLEND_ADD, 0.75f, 1.25f },
        { FM_BLEND_MAX, 0.5f, 0.75f },
        { FM_BLEND_MIN, 0.25f, 0.5f },
        { FM_BLEND_OVER, 0.25f + 0.5f * 0.25f, 0.75f + 0.5f * 0.25f },
        { FM_BLEND_UNDER, 0.5f + 0.25f * 0.5f, 0.5f * 0.25f },
        { FM_BLEND_PRODUCT, 0.5f * 0.75f, 0.5f * 0.25f },
    };
    fm_device *device = device_of(state);
    _Static_assert(sizeof cases / sizeof cases[0] == FM_BLEND_COUNT, "each blend once");
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++)
        check_blend(device, &cases[i]);
}

/* Every fragment takes one from the stencil; number `iteration` to arrive finds the reference. */
static uint32_t route(fm_device *device, uint32_t iteration)
{
    uint32_t words[PIXELS];
    fm_image_resource *target = make_image(device, FM_FORMAT_R32UI, 1);
    fm_image_resource *stencil = make_image(device, FM_FORMAT_D32F_S8, 1);
    fm_pipeline *pipeline = make_pipeline(
        device, (fm_pipeline_desc){ .fragment = instance_fragment,
                                    .targets = { { .format = FM_FORMAT_R32UI } },
                                    .target_count = 1,
                                    .depth_stencil = FM_FORMAT_D32F_S8,
                                    .iteration = iteration,
                                    .state = { .stencil_test = FM_COMPARE_EQUAL,
                                               .stencil_reference = 7,
                                               .stencil_reference_step = ~0u, /* -1 */
                                               .stencil_fail = FM_STENCIL_DECREMENT,
                                               .stencil_pass = FM_STENCIL_DECREMENT } });
    const fm_draw command = { .pipeline = pipeline,
                              .targets = { target },
                              .target_loads = { FM_LOAD_CLEAR },
                              .target_count = 1,
                              .depth_stencil = stencil,
                              .depth_stencil_load = FM_LOAD_CLEAR,
                              .clear_stencil = 7 };
    begin(device);
    draw(device, command, 3);
    end_and_fetch(words, device, target, FETCH_UINT);
    device->ops->pipeline_destroy(device, pipeline);
    device->ops->image_destroy(device, target);
    device->ops->image_destroy(device, stencil);
    return words[33];
}

static void device_routes_fragments_by_stencil(void **state)
{
    fm_device *device = device_of(state);
    for (uint32_t i = 0; i < 3; i++)
        assert_int_equal(route(device, i), 10 + i);
    assert_int_equal(route(device, 3), 0); /* nobody */
}

typedef struct stencil_case {
    fm_stencil_op op;
    uint32_t before, after; /* with 9 for reference */
} stencil_case;

/* Draws everywhere, and returns how many samples passed. */
static uint64_t draw_stencil(fm_device *device, fm_image_resource *stencil, const fm_state *fixed,
                             const uint32_t *clear)
{
    fm_pipeline *pipeline =
        make_pipeline(device, (fm_pipeline_desc){ .fragment = "#version 450\nvoid main() {}\n",
                                                  .depth_stencil = FM_FORMAT_D32F_S8,
                                                  .state = *fixed });
    begin(device);
    draw(device,
         (fm_draw){ .pipeline = pipeline,
                    .depth_stencil = stencil,
                    .depth_stencil_load = clear != NULL ? FM_LOAD_CLEAR : FM_LOAD_KEEP,
                    .clear_depth = 1.0f,
                    .clear_stencil = clear != NULL ? *clear : 0,
                    .query = 1 },
         1);
    const fm_frame_times times = end(device);
    device->ops->pipeline_destroy(device, pipeline);
    return times.query[1];
}

/* The operation must be reached: `fixed` says in which of its three places it stands. */
static void check_stencil(fm_device *device, const stencil_case *expected, const fm_state *fixed)
{
    fm_image_resource *stencil = make_image(device, FM_FORMAT_D32F_S8, 1);
    const fm_state finds = { .stencil_test = FM_COMPARE_EQUAL,
                             .stencil_reference = expected->after };
    draw_stencil(device, stencil, fixed, &expected->before);
    if (draw_stencil(device, stencil, &finds, NULL) != PIXELS)
        fail_msg("operation %d does not make %u of %u", (int)expected->op, expected->after,
                 expected->before);
    device->ops->image_destroy(device, stencil);
}

static void device_changes_the_stencil_in_three_places(void **state)
{
    static const stencil_case cases[] = {
        { FM_STENCIL_KEEP, 5, 5 },
        { FM_STENCIL_ZERO, 5, 0 },
        { FM_STENCIL_REPLACE, 5, 9 },
        { FM_STENCIL_INCREMENT, 255, 255 },
        { FM_STENCIL_DECREMENT, 0, 0 },
        { FM_STENCIL_INVERT, 0x5A, 0xA5 },
        { FM_STENCIL_INCREMENT_WRAP, 255, 0 },
        { FM_STENCIL_DECREMENT_WRAP, 0, 255 },
    };
    fm_device *device = device_of(state);
    _Static_assert(sizeof cases / sizeof cases[0] == FM_STENCIL_OP_COUNT, "each operation once");
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        const fm_state fails = { .stencil_test = FM_COMPARE_NEVER,
                                 .stencil_reference = 9,
                                 .stencil_fail = cases[i].op };
        const fm_state is_hidden = { .stencil_test = FM_COMPARE_ALWAYS,
                                     .stencil_reference = 9,
                                     .depth_test = FM_COMPARE_NEVER,
                                     .stencil_depth_fail = cases[i].op };
        const fm_state passes = { .stencil_test = FM_COMPARE_ALWAYS,
                                  .stencil_reference = 9,
                                  .stencil_pass = cases[i].op };
        check_stencil(device, &cases[i], &fails);
        check_stencil(device, &cases[i], &is_hidden);
        check_stencil(device, &cases[i], &passes);
    }
}

static void device_masks_samples(void **state)
{
    fm_device *device = device_of(state);
    uint32_t words[PIXELS];
    if ((device->caps.colour_samples & 1u << 4) == 0)
        skip();
    fm_image_resource *target = make_image(device, FM_FORMAT_R32F, 4);
    begin(device);
    fm_pipeline *pipelines[3];
    for (uint32_t i = 0; i < 3; i++) {
        pipelines[i] = make_pipeline(
            device,
            (fm_pipeline_desc){ .fragment = instance_fragment_float,
                                .targets = { { .format = FM_FORMAT_R32F, .blend = FM_BLEND_ADD } },
                                .target_count = 1,
                                .samples = 4,
                                .iteration = i,
                                .state = { .sample_mask = 2, .sample_mask_step = 1 } });
        draw(device,
             (fm_draw){ .pipeline = pipelines[i],
                        .targets = { target },
                        .target_loads = { i == 0 ? FM_LOAD_CLEAR : FM_LOAD_KEEP },
                        .target_count = 1 },
             i + 1);
    }
    end_and_fetch(words, device, target, fetch_samples);
    /* one instance into sample 1, two (1 + 2) into 2, three (1 + 2 + 3) into 3 */
    assert_int_equal(words[120], 1u << 8 | 3u << 16 | 6u << 24);
    for (uint32_t i = 0; i < 3; i++)
        device->ops->pipeline_destroy(device, pipelines[i]);
    device->ops->image_destroy(device, target);
}

static void device_counts_samples_that_pass(void **state)
{
    fm_device *device = device_of(state);
    uint32_t words[PIXELS];
    fm_image_resource *depth = make_image(device, FM_FORMAT_D32F, 1);
    fm_pipeline *pipeline = make_pipeline(
        device,
        (fm_pipeline_desc){ .fragment = "#version 450\nvoid main() {}\n",
                            .depth_stencil = FM_FORMAT_D32F,
                            .state = { .depth_test = FM_COMPARE_LESS, .depth_write = true } });
    fm_draw command = { .pipeline = pipeline,
                        .depth_stencil = depth,
                        .depth_stencil_load = FM_LOAD_CLEAR,
                        .clear_depth = 0.6f,
                        .query = 3 };
    begin(device);
    draw(device, command, 3); /* the first is at 0.75 */
    command.depth_stencil_load = FM_LOAD_KEEP;
    command.query = 5;
    draw(device, command, 3);
    command.query = 3;
    command.depth_stencil_load = FM_LOAD_CLEAR;
    draw(device, command, 2);
    const fm_frame_times times = end_and_fetch(words, device, depth, FETCH_RED);
    assert_int_equal(times.query[3], 3 * PIXELS); /* two, and one more */
    assert_int_equal(times.query[5], 0);
    assert_int_equal(times.query[4], 0);
    device->ops->pipeline_destroy(device, pipeline);
    device->ops->image_destroy(device, depth);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        ON_EACH_DEVICE(device_draws_at_the_pixels_vulkan_says),
        ON_EACH_DEVICE(device_keeps_the_nearest_by_depth),
        ON_EACH_DEVICE(device_blends_as_the_interface_says),
        ON_EACH_DEVICE(device_routes_fragments_by_stencil),
        ON_EACH_DEVICE(device_changes_the_stencil_in_three_places),
        ON_EACH_DEVICE(device_masks_samples),
        ON_EACH_DEVICE(device_counts_samples_that_pass),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
