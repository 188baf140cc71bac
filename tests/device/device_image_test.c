/* What every device does alike with images: stores by shaders, clears, layers. */
#include "fetch_kit.h"

static void device_clears_integers_as_bits(void **state)
{
    fm_device *device = device_of(state);
    uint32_t words[PIXELS];
    const float colour[4] = { as_float(0x12345678u) };
    fm_image_resource *target = make_image(device, FM_FORMAT_R32UI, 1);
    fm_image_resource *depth = make_image(device, FM_FORMAT_D32F, 1);
    fm_pipeline *pipeline =
        make_pipeline(device, (fm_pipeline_desc){ .fragment = instance_fragment,
                                                  .targets = { { FM_FORMAT_R32UI, 0, true } },
                                                  .target_count = 1 });
    fm_draw command = { .pipeline = pipeline,
                        .targets = { target },
                        .target_loads = { FM_LOAD_CLEAR },
                        .target_clears = { { as_float(0x00C0FFEEu) } },
                        .target_count = 1 };
    begin(device);
    draw(device, command, 1); /* writes nothing: the colour mask is off */
    end_and_fetch(words, device, target, FETCH_UINT);
    assert_int_equal(words[200], 0x00C0FFEEu);
    begin(device);
    device->ops->image_clear(device, target, colour, 0, 0);
    device->ops->image_clear(device, depth, colour, 0.625f, 0);
    end_and_fetch(words, device, target, FETCH_UINT);
    assert_int_equal(words[200], 0x12345678u);
    begin(device);
    end_and_fetch(words, device, depth, FETCH_RED);
    assert_true(as_float(words[200]) == 0.625f);
    device->ops->pipeline_destroy(device, pipeline);
    device->ops->image_destroy(device, target);
    device->ops->image_destroy(device, depth);
}

static void device_stores_to_images(void **state)
{
    static const char store[] = "#version 450\n"
                                "layout(local_size_x = 16, local_size_y = 16) in;\n"
                                "layout(binding = 0, r32ui) uniform uimage2D image;\n"
                                "void main() {\n"
                                "  ivec2 p = ivec2(gl_LocalInvocationID.xy);\n"
                                "  imageAtomicAdd(image, p, uint(p.y * 100 + p.x));\n"
                                "}\n";
    static const float zero[4] = { 0 };
    fm_device *device = device_of(state);
    uint32_t words[PIXELS];
    fm_image_resource *image = make_image(device, FM_FORMAT_R32UI, 1);
    fm_pipeline *pipeline =
        make_pipeline(device, (fm_pipeline_desc){ .compute = store,
                                                  .bindings = { { 0, FM_BINDING_STORAGE_IMAGE } },
                                                  .binding_count = 1 });
    const fm_bind bind = { .kind = FM_BINDING_STORAGE_IMAGE,
                           .image = image,
                           .access = FM_ACCESS_READ | FM_ACCESS_WRITE };
    begin(device);
    device->ops->image_clear(device, image, zero, 0, 0);
    dispatch(device, pipeline, &bind, 1, 1);
    dispatch(device, pipeline, &bind, 1, 1);
    end_and_fetch(words, device, image, FETCH_UINT);
    assert_int_equal(words[3 * SIDE_PX + 5], 2 * 305);
    device->ops->pipeline_destroy(device, pipeline);
    device->ops->image_destroy(device, image);
}

#define FETCH_LAYER(layer)                                                                         \
    FETCH_SOURCE("usampler2DArray", "texelFetch(image, ivec3(p, " layer "), 0).r")
static const char *const fetch_layer[] = { FETCH_LAYER("0"), FETCH_LAYER("1"), FETCH_LAYER("2") };
enum { LAYERS = sizeof fetch_layer / sizeof fetch_layer[0] };

/* Looks at one layer in a frame of its own. */
static void expect_layer(fm_device *device, fm_image_resource *image, uint32_t layer,
                         uint32_t pixel, uint32_t expected)
{
    uint32_t words[PIXELS];
    begin(device);
    end_and_fetch(words, device, image, fetch_layer[layer]);
    assert_int_equal(words[pixel], expected);
}

/* All layers are cleared; then every pixel of every layer gets a number of its own added. */
static void device_stores_into_every_layer(void **state)
{
    static const char store[] = "#version 450\n"
                                "layout(local_size_x = 16, local_size_y = 16) in;\n"
                                "layout(binding = 0, r32ui) uniform uimage2DArray image;\n"
                                "void main() {\n"
                                "  ivec3 p = ivec3(gl_LocalInvocationID.xy, gl_WorkGroupID.x);\n"
                                "  imageAtomicAdd(image, p, uint(p.z * 10000 + p.y * 100 + p.x));\n"
                                "}\n";
    const float colour[4] = { as_float(0x00700000u) };
    fm_device *device = device_of(state);
    fm_image_resource *image = make_layered_image(device, FM_FORMAT_R32UI, 1, LAYERS);
    fm_pipeline *pipeline =
        make_pipeline(device, (fm_pipeline_desc){ .compute = store,
                                                  .bindings = { { 0, FM_BINDING_STORAGE_IMAGE } },
                                                  .binding_count = 1 });
    const fm_bind bind = { .kind = FM_BINDING_STORAGE_IMAGE,
                           .image = image,
                           .access = FM_ACCESS_READ | FM_ACCESS_WRITE };
    begin(device);
    device->ops->image_clear(device, image, colour, 0, 0);
    dispatch(device, pipeline, &bind, 1, LAYERS);
    end(device);
    for (uint32_t layer = 0; layer < LAYERS; layer++) {
        expect_layer(device, image, layer, 0, 0x00700000u + layer * 10000);
        expect_layer(device, image, layer, PIXELS - 1, 0x00700000u + layer * 10000 + 1515);
    }
    device->ops->pipeline_destroy(device, pipeline);
    device->ops->image_destroy(device, image);
}

/* Also where the draw clears its target first: what lies in the other layers stays. */
static void device_draws_into_layer_0_alone(void **state)
{
    const float colour[4] = { as_float(0x77u) };
    fm_device *device = device_of(state);
    fm_image_resource *target = make_layered_image(device, FM_FORMAT_R32UI, 1, LAYERS);
    fm_pipeline *pipeline =
        make_pipeline(device, (fm_pipeline_desc){ .fragment = instance_fragment,
                                                  .targets = { { .format = FM_FORMAT_R32UI } },
                                                  .target_count = 1 });
    begin(device);
    device->ops->image_clear(device, target, colour, 0, 0);
    draw(device,
         (fm_draw){ .pipeline = pipeline,
                    .targets = { target },
                    .target_loads = { FM_LOAD_CLEAR },
                    .target_count = 1 },
         2);
    end(device);
    expect_layer(device, target, 0, 99, 11); /* the later instance */
    for (uint32_t layer = 1; layer < LAYERS; layer++)
        expect_layer(device, target, layer, 99, 0x77u);
    device->ops->pipeline_destroy(device, pipeline);
    device->ops->image_destroy(device, target);
}

static void device_clears_depth_in_every_layer(void **state)
{
    static const float none[4] = { 0 };
    static const char fetch[] = FETCH_SOURCE(
        "sampler2DArray", "floatBitsToUint(texelFetch(image, ivec3(p, p.y & 1), 0).r)");
    fm_device *device = device_of(state);
    uint32_t words[PIXELS];
    fm_image_resource *depth = make_layered_image(device, FM_FORMAT_D32F_S8, 1, 2);
    begin(device);
    device->ops->image_clear(device, depth, none, 0.375f, 3);
    end_and_fetch(words, device, depth, fetch);
    for (uint32_t i = 0; i < PIXELS; i++) /* even rows look at layer 0, odd ones at layer 1 */
        assert_true(as_float(words[i]) == 0.375f);
    device->ops->image_destroy(device, depth);
}

/* Sample 0 of layer 0 and sample 3 of layer 1, a half of a word each. */
static void device_clears_every_sample_of_every_layer(void **state)
{
    static const char fetch[] =
        FETCH_SOURCE("usampler2DMSArray", "texelFetch(image, ivec3(p, 0), 0).r | "
                                          "texelFetch(image, ivec3(p, 1), 3).r << 16");
    const float colour[4] = { as_float(0x1234u) };
    fm_device *device = device_of(state);
    uint32_t words[PIXELS];
    if ((device->caps.colour_samples & 1u << 4) == 0)
        skip();
    fm_image_resource *image = make_layered_image(device, FM_FORMAT_R32UI, 4, 2);
    begin(device);
    device->ops->image_clear(device, image, colour, 0, 0);
    end_and_fetch(words, device, image, fetch);
    for (uint32_t i = 0; i < PIXELS; i++)
        assert_int_equal(words[i], 0x12341234u);
    device->ops->image_destroy(device, image);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        ON_EACH_DEVICE(device_clears_integers_as_bits),
        ON_EACH_DEVICE(device_stores_to_images),
        ON_EACH_DEVICE(device_stores_into_every_layer),
        ON_EACH_DEVICE(device_draws_into_layer_0_alone),
        ON_EACH_DEVICE(device_clears_depth_in_every_layer),
        ON_EACH_DEVICE(device_clears_every_sample_of_every_layer),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
