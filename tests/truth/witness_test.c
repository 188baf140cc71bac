/* A third opinion on truth: depth peeling on OpenGL, with shaders and draws of its own. It shares
 * nothing with truth but the scene's vertices: layer after layer, each pass keeps of every pixel
 * the nearest depth behind the last one, until a pass draws nothing. */
#include <stdio.h>
#include <unistd.h>

#include "capture/truth_capture.h"
#include "generators/generate.h"
#include "kit/scene_kit.h"

/* No scene here has more than a few dozen layers. */
enum { PEELED_MAX = 64, GROUP = 64 };

/* What a pixel holds before the first layer, and once it has no more: nearer and farther than all.
 */
static const float before_all[4] = { -1, -1, -1, -1 };
static const float no_more[4] = { 2, 2, 2, 2 };

static const char vertex_glsl[] =
    "#version 450\n"
    "layout(location = 0) in vec3 position;\n"
    "invariant gl_Position;\n"
    "layout(binding = 0, std430) readonly buffer Matrices { vec4 column[]; };\n"
    "void main() {\n"
    "  int first = 4 * gl_InstanceIndex;\n"
    "  gl_Position = column[first] * position.x + column[first + 1] * position.y\n"
    "      + column[first + 2] * position.z + column[first + 3];\n"
    "}\n";
static const char peel_glsl[] =
    "#version 450\n"
    "layout(binding = 1) uniform sampler2D last;\n"
    "layout(location = 0) out float peeled;\n"
    "void main() {\n"
    "  if (gl_FragCoord.z <= texelFetch(last, ivec2(gl_FragCoord.xy), 0).x)\n"
    "    discard;\n"
    "  peeled = gl_FragCoord.z;\n"
    "}\n";
static const char keep_glsl[] =
    "#version 450\n"
    "layout(local_size_x = 64) in;\n"
    "layout(binding = 0, std430) writeonly buffer Kept { float kept[]; };\n"
    "layout(binding = 1) uniform sampler2D peeled;\n"
    "void main() {\n"
    "  int width = textureSize(peeled, 0).x, id = int(gl_GlobalInvocationID.x);\n"
    "  if (id < width * textureSize(peeled, 0).y)\n"
    "    kept[id] = texelFetch(peeled, ivec2(id % width, id / width), 0).x;\n"
    "}\n";

typedef struct witness {
    fm_device *device;
    uint32_t width_px, height_px, pixels;
    fm_buffer *vertices, *indices, *matrices, *kept;
    uint32_t index_count, instances;
    fm_image_resource *layer[2], *depth;
    fm_pipeline *peel, *keep;
    float *depths; /* [PEELED_MAX][pixels] */
    uint32_t layers;
} witness;

static fm_buffer *upload(witness *w, fm_buffer_desc desc, const void *bytes)
{
    fm_buffer *buffer = make_buffer(w->device, desc);
    assert_int_equal(w->device->ops->buffer_write(w->device, buffer, 0, bytes, desc.bytes, NULL),
                     FM_OK);
    return buffer;
}

static fm_image_resource *make_viewport(witness *w, fm_format format)
{
    fm_image_resource *image = NULL;
    fm_error err = { .message = "" };
    const fm_image_desc desc = {
        .name = "peel", .format = format, .width_px = w->width_px, .height_px = w->height_px
    };
    if (w->device->ops->image_create(&image, w->device, &desc, &err) != FM_OK)
        fail_msg("%s", err.message);
    return image;
}

static void make_pipelines(witness *w)
{
    w->peel = make_pipeline(
        w->device,
        (fm_pipeline_desc){
            .vertex = vertex_glsl,
            .fragment = peel_glsl,
            .state = { .depth_test = FM_COMPARE_LESS_EQUAL, .depth_write = true },
            .targets = { { .format = FM_FORMAT_R32F } },
            .target_count = 1,
            .depth_stencil = FM_FORMAT_D32F,
            .vertex_stride_bytes = sizeof(fm_vertex),
            .attributes = { { .location = 0, .element = FM_ELEMENT_FLOAT, .is_vec3 = true } },
            .attribute_count = 1,
            .bindings = { { 0, FM_BINDING_STORAGE }, { 1, FM_BINDING_SAMPLED } },
            .binding_count = 2,
        });
    w->keep = make_pipeline(
        w->device,
        (fm_pipeline_desc){ .compute = keep_glsl,
                            .bindings = { { 0, FM_BINDING_STORAGE }, { 1, FM_BINDING_SAMPLED } },
                            .binding_count = 2 });
}

static void witness_open(witness *w, fm_device *device, const fm_scene *scene)
{
    *w = (witness){ .device = device,
                    .width_px = scene->width_px,
                    .height_px = scene->height_px,
                    .pixels = scene->width_px * scene->height_px,
                    .index_count = scene->index_count,
                    .instances = scene->instances };
    w->vertices = upload(
        w, (fm_buffer_desc){ .bytes = scene->vertex_count * sizeof(fm_vertex), .is_vertex = true },
        scene->vertices);
    w->indices = upload(w, (fm_buffer_desc){ .bytes = scene->index_count * 4ull, .is_index = true },
                        scene->indices);
    w->matrices =
        upload(w, (fm_buffer_desc){ .bytes = scene->instances * 64ull }, scene->clip_from_object);
    w->kept = make_buffer(device, (fm_buffer_desc){ .bytes = w->pixels * 4ull });
    for (int i = 0; i < 2; i++)
        w->layer[i] = make_viewport(w, FM_FORMAT_R32F);
    w->depth = make_viewport(w, FM_FORMAT_D32F);
    make_pipelines(w);
    w->depths = calloc((size_t)PEELED_MAX * w->pixels, sizeof *w->depths);
    assert_non_null(w->depths);
}

static void witness_close(witness *w)
{
    const fm_device_ops *ops = w->device->ops;
    ops->pipeline_destroy(w->device, w->peel);
    ops->pipeline_destroy(w->device, w->keep);
    for (int i = 0; i < 2; i++)
        ops->image_destroy(w->device, w->layer[i]);
    ops->image_destroy(w->device, w->depth);
    ops->buffer_destroy(w->device, w->vertices);
    ops->buffer_destroy(w->device, w->indices);
    ops->buffer_destroy(w->device, w->matrices);
    ops->buffer_destroy(w->device, w->kept);
    free(w->depths);
}

/* Draws the next layer into `to`, behind what `from` holds. */
static void draw_layer(witness *w, fm_image_resource *to, fm_image_resource *from)
{
    fm_error err = { .message = "" };
    const fm_bind binds[] = { bind_words(0, w->matrices, FM_ACCESS_READ), bind_sampled(1, from) };
    fm_draw command = { .pipeline = w->peel,
                        .binds = binds,
                        .bind_count = 2,
                        .width_px = w->width_px,
                        .height_px = w->height_px,
                        .targets = { to },
                        .target_loads = { FM_LOAD_CLEAR },
                        .target_count = 1,
                        .depth_stencil = w->depth,
                        .depth_stencil_load = FM_LOAD_CLEAR,
                        .clear_depth = 1,
                        .vertices = w->vertices,
                        .indices = w->indices,
                        .vertex_count = w->index_count,
                        .instance_count = w->instances,
                        .query = 0 };
    memcpy(command.target_clears[0], no_more, sizeof no_more);
    if (w->device->ops->draw(w->device, &command, &err) != FM_OK)
        fail_msg("%s", err.message);
}

/* Peels until nothing is drawn; depths then hold w->layers images. */
static void peel_all(witness *w)
{
    const fm_device_ops *ops = w->device->ops;
    for (;;) {
        fm_image_resource *to = w->layer[w->layers % 2], *from = w->layer[1 - w->layers % 2];
        const fm_bind binds[] = { bind_words(0, w->kept, FM_ACCESS_WRITE), bind_sampled(1, to) };
        begin(w->device);
        if (w->layers == 0)
            ops->image_clear(w->device, from, before_all, 0, 0);
        draw_layer(w, to, from);
        dispatch(w->device, w->keep, binds, 2, (w->pixels + GROUP - 1) / GROUP);
        if (end(w->device).query[0] == 0)
            return;
        assert_true(w->layers < PEELED_MAX);
        assert_int_equal(ops->buffer_read(w->device, w->kept, 0,
                                          w->depths + (size_t)w->layers * w->pixels,
                                          w->pixels * 4ull, NULL),
                         FM_OK);
        w->layers++;
    }
}

/* Whether the pixel's distinct depths are those of the witness, bit for bit. */
static bool pixel_agrees(const witness *w, const fm_truth *truth, uint32_t pixel)
{
    uint32_t layer = 0;
    for (uint64_t i = truth->offsets[pixel]; i < truth->offsets[pixel + 1]; i++) {
        const float *depth = &truth->fragments[i].depth;
        if (i > truth->offsets[pixel] &&
            memcmp(depth, &truth->fragments[i - 1].depth, sizeof *depth) == 0)
            continue;
        if (layer == w->layers ||
            memcmp(depth, &w->depths[(size_t)layer * w->pixels + pixel], sizeof *depth) != 0)
            return false;
        layer++;
    }
    return layer == w->layers || w->depths[(size_t)layer * w->pixels + pixel] >= no_more[0];
}

static uint32_t count_different(const witness *w, const fm_truth *truth)
{
    uint32_t different = 0;
    assert_int_equal(truth->width_px * truth->height_px, w->pixels);
    for (uint32_t pixel = 0; pixel < w->pixels; pixel++)
        different += !pixel_agrees(w, truth, pixel);
    return different;
}

/* Truth of `device` against the witness; skipped where there is no such device. */
static void compare_truth(const witness *w, const char *device_name, const fm_scene *scene)
{
    char path[] = "/tmp/fm-truth-XXXXXX";
    fm_device *device = open_if_there(device_name, &(fm_device_desc){ .selector = NULL });
    fm_truth *truth = NULL;
    fm_error err = { .message = "" };
    scene_kit kit;
    if (device == NULL)
        return;
    kit_open(&kit, device);
    const int fd = mkstemp(path);
    assert_true(fd >= 0);
    close(fd);
    const fm_shader_folders folders = { .method = kit.plugins.common_folder,
                                        .common = kit.plugins.common_folder };
    if (truth_capture(path, device, scene, FM_FEED_RASTER, &folders, &err) != FM_OK ||
        truth_open(&truth, path, &err) != FM_OK)
        fail_msg("%s", err.message);
    unlink(path);
    const uint32_t different = count_different(w, truth);
    print_message("%s: %u of %u covered pixels differ from the witness of %u layers\n", device_name,
                  different, (unsigned)truth->nonempty_pixels, w->layers);
    assert_true(truth->nonempty_pixels > 0);
    /* A GPU rasterises edges by the same rules but may round depths its own way. */
    if (device->caps.is_software)
        assert_int_equal(different, 0);
    truth_close(truth);
    kit_close(&kit);
    device_close(device);
}

static void testify(fm_device *device, const fm_scene *drawn, const fm_scene *scene)
{
    witness w;
    witness_open(&w, device, drawn);
    peel_all(&w);
    compare_truth(&w, "osmesa", scene);
    compare_truth(&w, "vulkan", scene);
    witness_close(&w);
}

static fm_scene *make_scene(const char *const (*texts)[2])
{
    fm_settings settings;
    fm_scene *scene = NULL;
    fm_error err = { .message = "" };
    settings_default(&settings);
    for (; (*texts)[0] != NULL; texts++)
        assert_int_equal(settings_set(&settings, key_find((*texts)[0]), (*texts)[1], NULL), FM_OK);
    if (settings_finish(&settings, &err) != FM_OK || scene_create(&scene, &settings, &err) != FM_OK)
        fail_msg("%s", err.message);
    return scene;
}

#define BUNNY "/usr/share/glmark2/models/bunny.obj"

static void truth_of_the_bunny_agrees_with_depth_peeling(void **state)
{
    static const char *const texts[][2] = { { "generator", "mesh" },
                                            { "mesh", BUNNY },
                                            { "width_px", "256" },
                                            { "height_px", "256" },
                                            { NULL, NULL } };
    fm_device *device = device_of(state);
    if (access(BUNNY, R_OK) != 0) {
        print_message("skipped: %s is not there (apt-get install glmark2-data)\n", BUNNY);
        skip();
    }
    fm_scene *scene = make_scene(texts);
    testify(device, scene, scene);
    scene_destroy(scene);
}

/* The witness draws each layer as one quad of its own making. */
static void truth_of_layers_agrees_with_depth_peeling(void **state)
{
    static const char *const texts[][2] = {
        { "width_px", "61" },    { "height_px", "37" },      { "n", "12" },
        { "tessellation", "5" }, { "order", "random-cell" }, { "depths", "coplanar" },
        { NULL, NULL }
    };
    fm_device *device = device_of(state);
    fm_scene *scene = make_scene(texts);
    fm_scene *drawn = kit_quads_create(scene->width_px, scene->height_px, scene->n);
    for (uint32_t i = 0; i < scene->n; i++)
        kit_quad(drawn, i, scene->rect, scene->layers[i].depth, scene->layers[i].colour);
    testify(device, drawn, scene);
    scene_destroy(drawn);
    scene_destroy(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(truth_of_the_bunny_agrees_with_depth_peeling, open_osmesa,
                                        close_opened),
        cmocka_unit_test_setup_teardown(truth_of_layers_agrees_with_depth_peeling, open_osmesa,
                                        close_opened),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
