/* Lemma 2.1 of occupancy maps: the k nearest fragments always pass. Every exact method, culled, on
 * 500 random scenes: layers of all kinds of depths, and triangles seen by cameras that stand
 * before, near and inside them, with planes that cut them. FRAGMARK_TEST_SLICE=3/100 runs the third
 * hundredth; scene i alone is slice (i + 1)/500. And broken maps, which must be caught. */
#include <math.h>
#include <stdio.h>

#include "kit/scene_kit.h"
#include "random_kit.h"
#include "scene/camera.h"

enum { SCENES = 500, BROKEN_SCENES = 60, FAILURES_SHOWN = 20, TRIES = 4 };

/* ---- scenes ---- */

static const uint32_t k_values[] = { 1, 2, 3, 4, 8, 15, 16, 17, 32, 33, 64 };
enum { K_COUNT = sizeof k_values / sizeof k_values[0] };

static void open_layers(kit_scene *scene, scene_kit *kit, uint64_t *state, uint32_t k)
{
    static const char *const orders[] = { "random", "random-cell", "ascending", "descending",
                                          "cell-major" };
    static const char *const depths[] = { "uniform", "clustered", "coplanar", "ulp",
                                          "sloped",  "equal",     "step24",   "ends" };
    char texts[320];
    const uint32_t many = draw_in(state, 0, 7) == 0 ? 160 : 40;
    const uint32_t n =
        draw_in(state, 0, 3) == 0 ? k + draw_in(state, 0, 2) : draw_in(state, 0, many);
    snprintf(texts, sizeof texts,
             "n=%u width_px=%u height_px=%u order=%s depths=%s pixel_density=0.%u "
             "fragment_probability=0.%u tessellation=%u seed=%u",
             n, draw_in(state, 1, 67), draw_in(state, 1, 41), orders[draw_in(state, 0, 4)],
             depths[draw_in(state, 0, 7)], draw_in(state, 1, 9), draw_in(state, 1, 9),
             draw_in(state, 1, 5), draw_in(state, 1, 1000000));
    kit_scene_open(scene, kit, texts);
}

/* An eye before, near or inside the cube of side 2, and planes that may cut it. */
static void draw_camera(fm_settings *settings, uint64_t *state)
{
    const float away = draw_in(state, 0, 2) == 0 ? 0.5f : 3.0f;
    for (int axis = 0; axis < 3; axis++) {
        settings->eye[axis] = (double)draw_real(state, -away, away);
        settings->target[axis] = (double)draw_real(state, -0.2f, 0.2f);
    }
    settings->near_plane = draw_in(state, 0, 1) == 0 ? 0.01 : (double)draw_real(state, 0.1f, 3.0f);
    settings->far_plane = settings->near_plane + (double)draw_real(state, 0.5f, 8.0f);
    settings->fov_deg = (double)draw_real(state, 30.0f, 100.0f);
}

static void put_matrices(fm_scene *scene, uint64_t *state)
{
    const fm_box box = { { -1, -1, -1 }, { 1, 1, 1 } };
    double matrix[16];
    do
        draw_camera(&scene->settings, state);
    while (camera_matrix(matrix, &scene->settings, &(fm_space){ 0 }, &box, NULL) != FM_OK);
    for (uint32_t i = 0; i < scene->instances; i++) {
        const double shift = 0.3 * i;
        for (int j = 0; j < 16; j++)
            scene->clip_from_object[16 * i + (uint32_t)j] = (float)matrix[j];
        for (int row = 0; row < 4; row++)
            scene->clip_from_object[16 * i + 12 + (uint32_t)row] =
                (float)(matrix[12 + row] + shift * matrix[row]);
    }
}

/* Big triangles and small ones, some in one plane. */
static void open_triangles(kit_scene *scene, scene_kit *kit, uint64_t *state)
{
    const uint32_t quads = draw_in(state, 1, 60), instances = draw_in(state, 1, 2);
    const uint32_t width = draw_in(state, 1, 67), height = draw_in(state, 1, 41);
    fm_scene *made = kit_quads_create(width, height, quads);
    const bool is_flat = draw_in(state, 0, 9) == 0;
    made->clip_from_object = realloc(made->clip_from_object, instances * 16 * sizeof(float));
    assert_non_null(made->clip_from_object);
    made->instances = made->settings.instances = instances;
    made->triangles *= instances;
    for (uint32_t i = 0; i < made->vertex_count; i++) {
        float *position = made->vertices[i].position;
        for (int axis = 0; axis < 3; axis++)
            position[axis] = draw_real(state, -1, 1);
        if (is_flat)
            position[2] = 0.25f;
        made->vertices[i].colour = 0x40000000u + i;
    }
    put_matrices(made, state);
    kit_scene_take(scene, kit, made);
}

typedef struct drawn_scene {
    kit_scene scene;
    uint64_t state; /* for the choices that follow */
    uint32_t number, k;
} drawn_scene;

static void open_scene(drawn_scene *drawn, scene_kit *kit, uint32_t number)
{
    *drawn = (drawn_scene){ .state = 0x0CC00000u + number, .number = number };
    drawn->k = k_values[draw_in(&drawn->state, 0, K_COUNT - 1)];
    if (number % 3 == 2)
        open_triangles(&drawn->scene, kit, &drawn->state);
    else
        open_layers(&drawn->scene, kit, &drawn->state, drawn->k);
}

/* ---- a case ---- */

static void draw_texts(char texts[256], drawn_scene *drawn)
{
    static const char *const ranges[] = { "hull", "hull", "aabb", "exact" };
    const uint32_t least = (drawn->k + 31) / 32;
    const uint32_t words = draw_in(&drawn->state, 0, 1) == 0 ? draw_in(&drawn->state, least, 4)
                                                             : draw_in(&drawn->state, least, 64);
    snprintf(texts, 256,
             "k=%u culling=occupancy cull_words=%u cull_range=%s cull_test=%s cull_memory=%s "
             "own_cull=%s",
             drawn->k, words, ranges[draw_in(&drawn->state, 0, 3)],
             draw_in(&drawn->state, 0, 3) == 0 ? "shader" : "early",
             draw_in(&drawn->state, 0, 1) == 0 ? "shared" : "own",
             draw_in(&drawn->state, 0, 3) == 0 ? "off" : "on");
}

typedef struct outcomes {
    unsigned measured, failed, unsupported;
    uint64_t generated, arrived; /* fragments */
} outcomes;

/* A thread that owns a lock of a software rasteriser may be suspended longer than others wait for
 * it: such a case is tried again. */
static fm_status try_case(fm_measurement *m, kit_scene *scene, const kit_way *way, fm_error *err)
{
    fm_status status = kit_try(m, scene, way, true, err);
    for (int i = 1; i < TRIES && status == FM_OK && m->lost != 0; i++) {
        measurement_free(m);
        status = kit_try(m, scene, way, true, err);
    }
    return status;
}

static void measure_one(outcomes *seen, drawn_scene *drawn, const kit_way *way, bool is_quiet)
{
    fm_measurement m;
    fm_error err = { .message = "" };
    char where[256];
    const fm_status status = try_case(&m, &drawn->scene, way, &err);
    const fm_check *check = &m.check;
    const uint64_t wrong = check->missing + check->extra + check->misordered + m.lost;
    const bool is_right = status == FM_OK && wrong == 0 && m.bytes_allocated == m.bytes_predicted;
    kit_tell(where, way);
    if (is_quiet && status != FM_OK && status != FM_UNSUPPORTED)
        fail_msg("%s: a mistake must show in fragments: %s", where, err.message);
    seen->measured++;
    seen->unsupported += status == FM_UNSUPPORTED;
    seen->generated += status == FM_OK ? drawn->scene.truth->fragment_count : 0;
    seen->arrived += status == FM_OK ? m.arrived : 0;
    if (status != FM_UNSUPPORTED && !is_right && seen->failed++ < FAILURES_SHOWN && !is_quiet)
        print_error("scene %u: %s: missing %u, extra %u, misordered %u, lost %u, %llu bytes for "
                    "%llu %s\n",
                    drawn->number, where, (unsigned)check->missing, (unsigned)check->extra,
                    (unsigned)check->misordered, (unsigned)m.lost,
                    (unsigned long long)m.bytes_allocated, (unsigned long long)m.bytes_predicted,
                    err.message);
    measurement_free(&m);
}

static bool has_depth_one(const fm_truth *truth)
{
    for (uint64_t i = 0; i < truth->fragment_count; i++)
        if (!(truth->fragments[i].depth < 1.0f))
            return true;
    return false;
}

static void measure_all(outcomes *seen, drawn_scene *drawn)
{
    const scene_kit *kit = drawn->scene.kit;
    const bool any_ties = kit_has_ties(drawn->scene.truth);
    const bool any_one = has_depth_one(drawn->scene.truth);
    char texts[256];
    for (size_t i = 0; i < kit->plugins.count; i++) {
        const fm_method_desc *method = kit_method(kit, i);
        const kit_way way = { .method = method->id, .feed = FM_FEED_RASTER, .texts = texts };
        draw_texts(texts, drawn);
        if ((kit_feeds(method) & FM_FEED_RASTER) == 0)
            continue;
        if (method->keeps == FM_KEEPS_K_NEAREST && kit_is_right(method, any_ties) &&
            !(any_one && (method->traits & FM_TRAIT_LOSES_DEPTH_ONE) != 0))
            measure_one(seen, drawn, &way, false);
    }
}

/* True: the scene belongs to the slice; without the variable all do. */
static bool is_in_slice(uint32_t number)
{
    const char *text = getenv("FRAGMARK_TEST_SLICE");
    unsigned slice = 1, slices = 1;
    if (text != NULL && (sscanf(text, "%u/%u", &slice, &slices) != 2 || slices == 0 || slice == 0 ||
                         slice > slices))
        fail_msg("FRAGMARK_TEST_SLICE=%s: not like 3/100", text);
    return number % slices == slice - 1;
}

static void the_k_nearest_always_pass(void **state)
{
    scene_kit kit;
    drawn_scene drawn;
    outcomes seen = { .measured = 0 };
    uint32_t scenes = 0;
    kit_open(&kit, device_of(state));
    for (uint32_t number = 0; number < SCENES; number++) {
        if (!is_in_slice(number))
            continue;
        scenes++;
        open_scene(&drawn, &kit, number);
        measure_all(&seen, &drawn);
        kit_scene_close(&drawn.scene);
    }
    kit_close(&kit);
    print_message("%u measured, %u failed, %u not supported; %llu fragments of %llu arrived\n",
                  seen.measured, seen.failed, seen.unsupported, (unsigned long long)seen.arrived,
                  (unsigned long long)seen.generated);
    assert_int_equal(seen.failed, 0);
    if (scenes >= SCENES / 10) /* a few may have nothing to leave out */
        assert_true(seen.arrived < seen.generated);
}

/* ---- broken maps ---- */

/* What is broken: a text of a shader, or (file NULL) the method with its culling. */
typedef struct broken_map {
    kit_mistake mistake;
    void (*edit)(fm_method_desc *);
    const char *texts; /* where it shows; NULL: as scenes draw them */
} broken_map;

/* Whether one of the scenes shows it; they end there. */
static bool is_caught(void **state, const broken_map *broken)
{
    scene_kit kit;
    outcomes seen = { .measured = 0 };
    char texts[512];
    kit_open(&kit, device_of(state));
    if (broken->mistake.file != NULL)
        kit_break(&kit, &broken->mistake);
    for (uint32_t number = 0; number < BROKEN_SCENES && seen.failed == 0; number++) {
        drawn_scene drawn;
        const kit_way way = { "kplus-array", FM_FEED_RASTER, texts };
        open_scene(&drawn, &kit, number);
        draw_texts(texts, &drawn);
        if (broken->texts != NULL)
            strcat(strcat(texts, " "), broken->texts); /* the last text of a key counts */
        drawn.scene.edit = broken->edit;
        measure_one(&seen, &drawn, &way, broken->mistake.file != NULL || broken->edit != NULL);
        kit_scene_close(&drawn.scene);
    }
    kit_close(&kit);
    print_message("%u scenes, %u caught it\n", seen.measured, seen.failed);
    return seen.failed > 0;
}

static void expect_caught(void **state, const broken_map *broken)
{
    assert_true(is_caught(state, broken));
}

/* What the mistakes below are measured against. */
static void nothing_is_caught_where_nothing_is_broken(void **state)
{
    assert_false(is_caught(state, &(broken_map){ .texts = "cull_words=64 cull_test=early" }));
    assert_false(is_caught(state, &(broken_map){ .texts = "cull_words=64 cull_test=shader" }));
}

static void an_edge_one_bucket_too_near_is_caught(void **state)
{
    expect_caught(
        state, &(broken_map){ .mistake = { "cull_bucket.glsl", "float(j + 1u) /", "float(j) /" } });
}

/* Near, far, and between them a depth that is beyond the far edge of its bucket if the edge has no
 * margin: as cull_bucket.glsl counts, with 2048 buckets. One of 300 is. */
static void draw_edge(float depths[3], uint64_t *state)
{
    enum { BUCKETS = 2048, DRAWN_MAX = 100000 };
    for (int i = 0; i < DRAWN_MAX; i++) {
        const float near = draw_real(state, 0.0f, 0.5f), far = draw_real(state, 0.6f, 1.0f);
        const float bucket = (float)draw_in(state, 0, BUCKETS - 2);
        const float edge = near + (far - near) * ((bucket + 1.0f) / BUCKETS);
        const float depth = nextafterf(edge, 1.0f);
        depths[0] = near;
        depths[1] = depth;
        depths[2] = far;
        if (floorf((depth - near) * (BUCKETS / (far - near))) == bucket)
            return;
    }
    fail_msg("no depth is beyond its bucket's edge");
}

/* Three fragments a pixel: the ends of its range, and between them one that a narrow margin saves.
 */
static fm_scene *make_edges(uint32_t side)
{
    uint64_t state = 1;
    fm_scene *scene = kit_quads_create(side, side, 3 * side * side);
    for (uint32_t i = 0; i < side * side; i++) {
        const fm_rect px = { i % side, i / side, i % side + 1, i / side + 1 };
        float depths[3];
        draw_edge(depths, &state);
        for (uint32_t j = 0; j < 3; j++)
            kit_quad(scene, 3 * i + j, px, depths[j], 0x40000000u + j);
    }
    return scene;
}

static unsigned lost_at_edges(void **state, const kit_mistake *mistake)
{
    const kit_way way = { "kplus-array", FM_FEED_RASTER,
                          "k=2 culling=occupancy cull_words=64 cull_range=exact" };
    scene_kit kit;
    drawn_scene drawn = { .number = 0 };
    outcomes seen = { .measured = 0 };
    kit_open(&kit, device_of(state));
    if (mistake != NULL)
        kit_break(&kit, mistake);
    kit_scene_take(&drawn.scene, &kit, make_edges(16));
    measure_one(&seen, &drawn, &way, false);
    kit_scene_close(&drawn.scene);
    kit_close(&kit);
    assert_true(seen.arrived < seen.generated);
    return seen.failed;
}

static void an_edge_without_margin_is_caught(void **state)
{
    const kit_mistake mistake = { "cull_bucket.glsl", "(part + part * margin)", "part" };
    assert_int_equal(lost_at_edges(state, NULL), 0);
    assert_int_equal(lost_at_edges(state, &mistake), 1);
}

/* Fragments behind the range are in the last bucket. */
static void a_last_bucket_that_ends_is_caught(void **state)
{
    expect_caught(state,
                  &(broken_map){ .mistake = { "cull_bucket.glsl", "return 1.0;", "return far;" } });
}

/* ... and not in the first, or in one between. */
static void buckets_that_go_round_are_caught(void **state)
{
    expect_caught(state, &(broken_map){ .mistake = { "cull_bucket.glsl",
                                                     "clamp(at, 0.0, float(CULL_BUCKETS - 1u))",
                                                     "mod(max(at, 0.0), float(CULL_BUCKETS))" } });
}

static void a_count_of_k_less_one_is_caught(void **state)
{
    expect_caught(state, &(broken_map){ .mistake = { "cull_count.glsl", "wanted_bits = uint(K)",
                                                     "wanted_bits = uint(max(K - 1, 1))" } });
}

static void test_less(fm_method_desc *method)
{
    for (size_t i = 0; i < pass_count(method); i++)
        if (method->passes[i].state.depth_test == FM_COMPARE_LESS_EQUAL)
            method->passes[i].state.depth_test = FM_COMPARE_LESS;
}

/* A boundary of 1 culls nothing, a fragment at 1 included. */
static void an_early_test_of_less_is_caught(void **state)
{
    expect_caught(state, &(broken_map){ .edit = test_less, .texts = "cull_test=early" });
}

static void a_shader_test_of_less_is_caught(void **state)
{
    expect_caught(state, &(broken_map){ .mistake = { "raster_main.glsl", "depth <=", "depth <" },
                                        .texts = "cull_test=shader" });
}

#define ON_VULKAN(test)                                                                            \
    {                                                                                              \
#test, test, open_vulkan, close_opened, NULL                                               \
    }

int main(void)
{
    const struct CMUnitTest tests[] = {
        ON_VULKAN_AND_OSMESA(the_k_nearest_always_pass),
        ON_VULKAN(nothing_is_caught_where_nothing_is_broken),
        ON_VULKAN(an_edge_one_bucket_too_near_is_caught),
        ON_VULKAN(an_edge_without_margin_is_caught),
        ON_VULKAN(a_last_bucket_that_ends_is_caught),
        ON_VULKAN(buckets_that_go_round_are_caught),
        ON_VULKAN(a_count_of_k_less_one_is_caught),
        ON_VULKAN(an_early_test_of_less_is_caught),
        ON_VULKAN(a_shader_test_of_less_is_caught),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
