/* Images as method.h promises them to shaders: every colour format, clears of integers to any word,
 * atomics on fm_image_NAME, and layers that follow k. */
#include <stdio.h>

#include "kit/frame_kit.h"

#define HEAD .id = "images", .traits = FM_TRAIT_FLOOR

/* One image `surface` beside the result, written by `write` and looked at by `look`. */
static fm_method_desc written_image(fm_format format)
{
    return (fm_method_desc){
        HEAD,
        .resources = { { .name = "surface", .kind = FM_RESOURCE_IMAGE, .format = format },
                       { .name = "result", .extent = { .constant = 1 } } },
        .passes = { { .name = "write",
                      .kind = FM_PASS_PIXELS,
                      .shader = "write.glsl",
                      .writes = { "surface" } },
                    { .name = "look",
                      .kind = FM_PASS_PIXELS,
                      .shader = "look.glsl",
                      .reads = { "surface" },
                      .writes = { "result" } } },
    };
}

/* Channels whose value comes back within a step of the format, a bit each: to which side of a value
 * between two steps a store rounds is the device's choice. */
static const char look_at_floats[] =
    "void look(uvec2 pixel)\n{\n"
    "    if (pixel != uvec2(2u, 1u))\n        return;\n"
    "    vec4 apart = abs(fm_load_surface(pixel) - VALUE);\n"
    "    result[0] = uint(apart.x < STEP) | uint(apart.y < STEP) << 1 | uint(apart.z < STEP) << 2\n"
    "        | uint(apart.w < STEP) << 3;\n}\n";
#define VALUE "vec4(0.2001, 0.4001, 0.6001, 0.8001)"

static const struct float_format {
    fm_format format;
    const char *step; /* from one value of the format to the next, near 0.8 */
    uint32_t channels;
} float_formats[] = {
    { FM_FORMAT_R32F, "1e-6", 1 },       { FM_FORMAT_RG32F, "1e-6", 3 },
    { FM_FORMAT_RGBA32F, "1e-6", 15 },   { FM_FORMAT_RGBA8, "0.004", 15 },
    { FM_FORMAT_R8, "0.004", 1 },        { FM_FORMAT_R16, "1.6e-5", 1 },
    { FM_FORMAT_RG16, "1.6e-5", 3 },     { FM_FORMAT_RGBA16, "1.6e-5", 15 },
    { FM_FORMAT_R16F, "0.0005", 1 },     { FM_FORMAT_RG16F, "0.0005", 3 },
    { FM_FORMAT_RGBA16F, "0.0005", 15 },
};

static uint32_t channels_kept(fm_device *device, const fm_method_desc *method, const char *write,
                              const char *step)
{
    char look[1024];
    snprintf(look, sizeof look, "#define VALUE " VALUE "\n#define STEP %s\n%s", step,
             look_at_floats);
    const kit_file files[] = { { "write.glsl", write }, { "look.glsl", look } };
    return frames_run(device, &(kit_frames){ .method = method, .files = files, .file_count = 2 });
}

static void a_format_keeps_what_a_shader_stores(void **state)
{
    static const char write[] = "void write(uvec2 pixel) { fm_store_surface(pixel, " VALUE "); }\n";
    for (size_t i = 0; i < sizeof float_formats / sizeof float_formats[0]; i++) {
        const struct float_format *row = &float_formats[i];
        const fm_method_desc method = written_image(row->format);
        assert_int_equal(channels_kept(device_of(state), &method, write, row->step), row->channels);
    }
}

/* The same as a target: of two equal halves one is there already and one is added. */
static void a_format_keeps_what_is_blended(void **state)
{
    static const char *const types[] = { [1] = "float", [3] = "vec2", [15] = "vec4" };
    for (size_t i = 0; i < sizeof float_formats / sizeof float_formats[0]; i++) {
        const struct float_format *row = &float_formats[i];
        char write[256];
        snprintf(write, sizeof write,
                 "void write(uvec2 pixel) { fm_target_surface = %s(0.5 * " VALUE "); }\n",
                 types[row->channels]);
        fm_method_desc method = written_image(row->format);
        memcpy(method.resources[0].clear_colour,
               (const float[4]){ 0.10005f, 0.20005f, 0.30005f, 0.40005f },
               sizeof method.resources[0].clear_colour);
        method.passes[0].writes[0] = NULL;
        method.passes[0].targets[0] =
            (fm_target){ .resource = "surface", .load = FM_LOAD_CLEAR, .blend = FM_BLEND_ADD };
        /* Three roundings instead of one: of the clear, the halves and the sum. */
        char step[32];
        snprintf(step, sizeof step, "2.0 * %s", row->step);
        assert_int_equal(channels_kept(device_of(state), &method, write, step), row->channels);
    }
}

/* All bits, a signalling NaN's, 1 and 0. */
#define WORDS                                                                                      \
    {                                                                                              \
        0xFFFFFFFFu, 0x7F800001u, 1u, 0u                                                           \
    }
static const char look_at_words[] =
    "void look(uvec2 pixel)\n{\n"
    "    bool is_right = fm_load_surface(pixel) == uvec4(0xFFFFFFFFu, 0x7F800001u, 1u, 0u);\n"
    "    if (pixel == uvec2(2u, 1u))\n        result[0] = uint(is_right);\n}\n";

static void expect_words(fm_device *device, const fm_pass *clear)
{
    const kit_file files[] = { { "look.glsl", look_at_words },
                               { "write.glsl", "void write(uvec2 pixel)\n{\n}\n" } };
    fm_method_desc method = written_image(FM_FORMAT_RGBA32UI);
    memcpy(method.resources[0].clear_words, (const uint32_t[4])WORDS,
           sizeof method.resources[0].clear_words);
    method.passes[0] = *clear;
    assert_int_equal(
        frames_run(device, &(kit_frames){ .method = &method, .files = files, .file_count = 2 }), 1);
}

static void an_integer_image_is_cleared_to_any_words(void **state)
{
    const fm_pass by_clear = { .name = "write", .kind = FM_PASS_CLEAR, .writes = { "surface" } };
    const fm_pass by_load = {
        .name = "write",
        .kind = FM_PASS_PIXELS,
        .shader = "write.glsl",
        .targets = { { .resource = "surface", .load = FM_LOAD_CLEAR, .no_write = true } },
    };
    expect_words(device_of(state), &by_clear);
    expect_words(device_of(state), &by_load);
}

/* Six invocations collide at one texel that was cleared to all ones. */
static void an_image_takes_atomics(void **state)
{
    static const kit_file files[] = {
        { "write.glsl", "void write(uvec2 pixel)\n{\n"
                        "    uint number = fm_pixel_index(pixel) + 3u;\n"
                        "    imageAtomicMin(fm_image_surface, ivec2(1, 1), number);\n"
                        "    imageAtomicAdd(fm_image_surface, ivec2(2, 1), number);\n}\n" },
        { "look.glsl", "void look(uvec2 pixel)\n{\n    if (pixel == uvec2(0u))\n"
                       "        result[0] = fm_load_surface(uvec2(1u, 1u)).x * 1000u\n"
                       "            + fm_load_surface(uvec2(2u, 1u)).x;\n}\n" },
    };
    fm_method_desc method = written_image(FM_FORMAT_R32UI);
    method.resources[0].clear_words[0] = UINT32_MAX;
    method.passes[2] = method.passes[1];
    method.passes[1] = method.passes[0];
    method.passes[0] = (fm_pass){ .name = "clear", .kind = FM_PASS_CLEAR, .writes = { "surface" } };
    const uint32_t least = 3, sum = 3 + 4 + 5 + 6 + 7 + 8 - 1; /* from UINT32_MAX on */
    assert_int_equal(
        frames_run(device_of(state),
                   &(kit_frames){ .method = &method, .files = files, .file_count = 2 }),
        least * 1000 + sum);
}

/* K + 1 layers: stored one by one, read and stored again, read through a sampler. */
static void an_image_has_layers_for_each_k(void **state)
{
    static const kit_file files[] = {
        { "write.glsl", "void write(uvec2 pixel)\n{\n"
                        "    for (uint layer = 0u; layer <= uint(K); ++layer)\n"
                        "        fm_store_surface(pixel, layer, uvec4(10u * layer));\n}\n" },
        { "add.glsl",
          "void add(uvec2 pixel)\n{\n"
          "    for (uint layer = 0u; layer <= uint(K); ++layer)\n"
          "        fm_store_surface(pixel, layer, fm_load_surface(pixel, layer) + 1u);\n"
          "}\n" },
        { "look.glsl", "void look(uvec2 pixel)\n{\n    uint sum = 0u;\n"
                       "    for (uint layer = 0u; layer <= uint(K); ++layer)\n"
                       "        sum += fm_load_surface(pixel, layer).x;\n"
                       "    if (pixel == uvec2(2u, 1u))\n        result[0] = sum;\n}\n" },
    };
    fm_method_desc method = written_image(FM_FORMAT_R32UI);
    method.resources[0].layers = 1;
    method.resources[0].layers_per_k = 1;
    method.passes[2] = method.passes[1];
    method.passes[1] = (fm_pass){
        .name = "add", .kind = FM_PASS_PIXELS, .shader = "add.glsl", .writes = { "surface" }
    };
    const kit_frames frames = { .method = &method,
                                .files = files,
                                .file_count = 3,
                                .scene = "width_px=3 height_px=2 n=0 k=4" };
    assert_int_equal(frames_run(device_of(state), &frames), 10 * (1 + 2 + 3 + 4) + 5);
}

/* A buffer or an image by the option's value; shaders learn which from its macro. */
static fm_method_desc with_stand_in(const char *first, const char *second)
{
    fm_method_desc method = written_image(FM_FORMAT_RG32UI);
    method.options[0] = (fm_option){ .name = "layout", .values = { first, second } };
    method.resources[2] = method.resources[1];
    method.resources[1] = (fm_resource){ .name = "surface",
                                         .kind = FM_RESOURCE_IMAGE,
                                         .format = FM_FORMAT_RG32UI,
                                         .extent = { .per_pixel_k = 1 },
                                         .when_option = "layout",
                                         .when_value = "image" };
    method.resources[0] = (fm_resource){ .name = "surface",
                                         .element = FM_ELEMENT_UVEC2,
                                         .extent = { .per_pixel_k = 1 } };
    return method;
}

/* With k = 1, too, the image has layers. */
static void an_image_stands_in_for_a_buffer_by_an_option(void **state)
{
    static const kit_file files[] = {
        { "write.glsl", "void write(uvec2 pixel)\n{\n"
                        "    for (uint i = 0u; i < uint(K); ++i)\n"
                        "#if LAYOUT == LAYOUT_IMAGE\n"
                        "        fm_store_surface(pixel, i, uvec4(10u + i, 0u, 0u, 0u));\n"
                        "#else\n"
                        "        surface[fm_pixel_index(pixel) * uint(K) + i].x = 20u + i;\n"
                        "#endif\n}\n" },
        { "look.glsl", "void look(uvec2 pixel)\n{\n"
                       "    uint i = uint(K) - 1u;\n"
                       "    if (pixel != uvec2(2u, 1u))\n        return;\n"
                       "#if LAYOUT == LAYOUT_IMAGE\n"
                       "    result[0] = fm_load_surface(pixel, i).x;\n"
                       "#else\n"
                       "    result[0] = surface[fm_pixel_index(pixel) * uint(K) + i].x;\n"
                       "#endif\n}\n" },
    };
    for (uint32_t k = 1; k <= 4; k += 3) {
        char scene[64];
        snprintf(scene, sizeof scene, "width_px=3 height_px=2 n=0 k=%u", k);
        const fm_method_desc image = with_stand_in("image", "pixel");
        const fm_method_desc buffer = with_stand_in("pixel", "image");
        kit_frames frames = { .method = &image, .files = files, .file_count = 2, .scene = scene };
        assert_int_equal(frames_run(device_of(state), &frames), 10 + k - 1);
        frames.method = &buffer;
        assert_int_equal(frames_run(device_of(state), &frames), 20 + k - 1);
    }
}

/* Not a failure, and not the driver's word for no memory. */
static void an_image_that_a_device_lacks_is_refused(void **state)
{
    static const kit_file files[] = {
        { "write.glsl", "void write(uvec2 pixel) { fm_store_surface(pixel, 0u, uvec4(1u)); }\n" },
        { "look.glsl", "void look(uvec2 pixel) { result[0] = fm_load_surface(pixel, 0u).x; }\n" },
    };
    enum { BROAD_PX = 512 };
    const fm_device_caps *caps = &device_of(state)->caps;
    const uint64_t largest_k = caps->image_max_bytes / ((uint64_t)BROAD_PX * BROAD_PX * 8) + 1;
    const struct {
        uint32_t side_px;
        uint64_t k;
        const char *message;
    } cases[] = { { 2, caps->image_layers + 1, "layers" }, { BROAD_PX, largest_k, "bytes" } };
    const fm_method_desc method = with_stand_in("image", "pixel");
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        frames_seen seen;
        fm_error err = { .message = "" };
        char scene[96];
        snprintf(scene, sizeof scene, "width_px=%u height_px=%u n=0 k=%llu", cases[i].side_px,
                 cases[i].side_px, (unsigned long long)cases[i].k);
        const kit_frames frames = {
            .method = &method, .files = files, .file_count = 2, .scene = scene
        };
        assert_int_equal(frames_try(&seen, device_of(state), &frames, &err), FM_UNSUPPORTED);
        assert_int_equal(err.reason, FM_REASON_DEVICE_LIMIT);
        if (strstr(err.message, cases[i].message) == NULL)
            fail_msg("'%s' is not in: %s", cases[i].message, err.message);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        ON_VULKAN_AND_OSMESA(a_format_keeps_what_a_shader_stores),
        ON_VULKAN_AND_OSMESA(a_format_keeps_what_is_blended),
        ON_VULKAN_AND_OSMESA(an_integer_image_is_cleared_to_any_words),
        ON_VULKAN_AND_OSMESA(an_image_takes_atomics),
        ON_VULKAN_AND_OSMESA(an_image_has_layers_for_each_k),
        ON_VULKAN_AND_OSMESA(an_image_stands_in_for_a_buffer_by_an_option),
        ON_VULKAN_AND_OSMESA(an_image_that_a_device_lacks_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
