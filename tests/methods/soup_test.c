/* Methods that rasterise by themselves: triangle soups against the host's rasteriser, pixel by
 * pixel; and that rasteriser against the device's. FRAGMARK_TEST_ALL=1: 1 000 soups, else some;
 * FRAGMARK_TEST_SOUPS="FIRST COUNT": those, so that the 1 000 can be done in pieces. */
#include <math.h>
#include <stdio.h>

#include "base/random.h"
#include "kit/scene_kit.h"

enum {
    SOUP_WIDTH = 67,
    SOUP_HEIGHT = 45,
    SOUP_TRIANGLES = 96,
    SOUPS_ALL = 1000,
    SOUPS_SOME = 2,
    SOUPS_INSIDE = 16,
    SOUPS_SOME_END = 19
};

/* notes=always chunk=wide: what a GPU does, as far as its subgroups' size is not in it. */
static const kit_way rasterisers[] = {
    { "tile-k", FM_FEED_TRIANGLES, "k=2" },
    { "tile-k", FM_FEED_TRIANGLES, "k=2 notes=always chunk=wide blocks=2" },
    { "freepipe-compute", FM_FEED_TRIANGLES, "" },
};
enum { RASTERISER_COUNT = sizeof rasterisers / sizeof rasterisers[0] };

static float uniform(uint64_t *random, float low, float high)
{
    return low + (high - low) * (float)(random_next(random) >> 40) * 0x1p-24f;
}

/* In view space, z into the picture; the frustum is |x|, |y| < z, z in 1..9. */
static void place(float position[3], uint64_t *random, float spread, const float around[3])
{
    for (int i = 0; i < 3; i++)
        position[i] = around[i] + uniform(random, -spread, spread);
}

/* What kinds of triangles a soup is made of. */
enum {
    KIND_ANY,    /* from slivers of a pixel to the whole screen */
    KIND_SHARED, /* uses two corners of the triangle before it */
    KIND_FLAT,   /* coplanar with others: ties of depth */
    KIND_TWICE,  /* the triangle before it once more */
    KIND_SLIVER, /* nearly no area, or none */
    KIND_HUGE,   /* through the planes, behind the eye, beyond the guard band */
    KIND_TINY,   /* below a pixel */
    KIND_COUNT
};

/* Within the planes that clip: such scenes have other shaders. */
static void hold_inside(float corners[3][3])
{
    for (int i = 0; i < 3; i++)
        corners[i][2] = fminf(fmaxf(corners[i][2], 1.1f), 8.9f);
}

static void make_corners(float corners[3][3], uint64_t *random, uint32_t kind)
{
    static const float spreads[KIND_COUNT] = { 2, 2, 3, 2, 1, 5000, 0.04f };
    const float z = uniform(random, 1.5f, 8.0f);
    const float around[3] = { uniform(random, -z, z), uniform(random, -z, z), z };
    const uint32_t first = kind == KIND_SHARED ? 2 : 0;
    if (kind == KIND_TWICE)
        return;
    for (uint32_t i = first; i < 3; i++)
        place(corners[i], random, spreads[kind], around);
    for (int i = 0; i < 3 && kind == KIND_FLAT; i++)
        corners[i][2] = 4.0f;
    for (int i = 0; i < 3 && kind == KIND_SLIVER; i++)
        corners[2][i] = (corners[0][i] + corners[1][i]) / 2 + uniform(random, -1e-3f, 1e-3f);
}

/* Perspective with w = z and depth (9 - 9 / z) / 8; row 1 turned, so that no row is another's. */
static void set_camera(float matrix[16])
{
    memset(matrix, 0, 16 * sizeof matrix[0]);
    matrix[0] = 1;
    matrix[5] = -1;
    matrix[10] = 9.0f / 8.0f;
    matrix[11] = 1;
    matrix[14] = -9.0f / 8.0f;
}

static fm_scene *make_soup(uint64_t seed)
{
    fm_scene *scene = kit_quads_create(SOUP_WIDTH, SOUP_HEIGHT, SOUP_TRIANGLES);
    float corners[3][3] = { { 0 } };
    uint64_t random = seed;
    const bool is_inside = seed / 8 % 3 == 2; /* all ways see both */
    scene->triangles = SOUP_TRIANGLES;
    scene->index_count = 3 * SOUP_TRIANGLES;
    scene->vertex_count = 3 * SOUP_TRIANGLES;
    for (uint32_t i = 0; i < SOUP_TRIANGLES; i++) {
        const uint32_t kind = i == 0 ? KIND_ANY : (uint32_t)random_below(&random, KIND_COUNT);
        make_corners(corners, &random, is_inside && kind == KIND_HUGE ? KIND_ANY : kind);
        if (is_inside)
            hold_inside(corners);
        for (uint32_t j = 0; j < 3; j++) {
            fm_vertex *vertex = &scene->vertices[3 * i + j];
            memcpy(vertex->position, corners[(j + i) % 3], sizeof vertex->position);
            vertex->colour = 0x40000000u | (uint32_t)(random_next(&random) & 0x3F3F3Fu);
            scene->indices[3 * i + j] = 3 * i + j;
        }
    }
    set_camera(scene->clip_from_object);
    return scene;
}

static void expect_exact(kit_scene *scene, const kit_way *way, uint64_t seed)
{
    fm_measurement m;
    char where[256];
    kit_tell(where, way);
    if (kit_measure(&m, scene, way)) {
        if (m.check.missing + m.check.extra + m.check.misordered + m.lost != 0)
            fail_msg("seed %u: %s: missing %u, extra %u, misordered %u, lost %u", (unsigned)seed,
                     where, (unsigned)m.check.missing, (unsigned)m.check.extra,
                     (unsigned)m.check.misordered, (unsigned)m.lost);
        if (m.bytes_allocated != m.bytes_predicted)
            fail_msg("%s: %u bytes allocated, %u predicted", where, (unsigned)m.bytes_allocated,
                     (unsigned)m.bytes_predicted);
        if (!(m.self_max_abs <= 1e-6))
            fail_msg("seed %u: %s: the image is %g off", (unsigned)seed, where, m.self_max_abs);
    }
    measurement_free(&m);
}

static void choose_soups(uint64_t *first, uint64_t *end)
{
    unsigned from = 0, count = kit_wants_all() ? SOUPS_ALL : SOUPS_SOME_END;
    const char *text = getenv("FRAGMARK_TEST_SOUPS");
    if (text != NULL && sscanf(text, "%u %u", &from, &count) != 2)
        fail_msg("FRAGMARK_TEST_SOUPS=\"%s\": not \"FIRST COUNT\"", text);
    *first = from;
    *end = (uint64_t)from + count;
}

/* Of the few that are run by default: some that need clipping, and some that do not. */
static bool is_left_out(uint64_t seed)
{
    const bool is_some = !kit_wants_all() && getenv("FRAGMARK_TEST_SOUPS") == NULL;
    return is_some && seed >= SOUPS_SOME && seed < SOUPS_INSIDE;
}

/* Few k, so that Mesa's cache holds their shaders. */
static void soups_are_rasterised_exactly(void **state)
{
    static const char *const ks[] = { "k=8 window=4",
                                      "k=100",
                                      "k=1",
                                      "k=8 structure=sorted-array",
                                      "k=100 used-buckets=1 structure=registers",
                                      "k=20 window=16",
                                      "k=12 structure=merge window=4",
                                      "k=100 notes=always chunk=wide blocks=2",
                                      "k=20 structure=shared-array",
                                      "k=3 notes=always" };
    enum { KS = sizeof ks / sizeof ks[0] };
    uint64_t first, end;
    scene_kit kit;
    choose_soups(&first, &end);
    kit_open(&kit, device_of(state));
    for (uint64_t seed = first; seed < end; seed++) {
        kit_scene scene;
        if (is_left_out(seed))
            continue;
        kit_scene_take(&scene, &kit, make_soup(seed));
        expect_exact(&scene, &(kit_way){ "tile-k", FM_FEED_TRIANGLES, ks[seed % KS] }, seed);
        if (seed % 2 == 0)
            expect_exact(&scene, &(kit_way){ "freepipe-compute", FM_FEED_TRIANGLES, "" }, seed);
        kit_scene_close(&scene);
    }
    kit_close(&kit);
}

/* 4 bytes a pair, 4 a triangle, 268 a tile, and 48: whatever k is. */
static void memory_does_not_depend_on_k(void **state)
{
    static const char *const ks[] = { "k=1", "k=4096" };
    const uint64_t tiles = (61 + 7) / 8 * ((37 + 7) / 8), blocks = (61 + 7) / 8 * ((37 + 3) / 4);
    scene_kit kit;
    kit_scene scene;
    kit_open(&kit, device_of(state));
    kit_scene_open(&scene, &kit, "n=1 width_px=61 height_px=37 pixel_density=1 tessellation=1");
    for (size_t i = 0; i < 2; i++) {
        fm_measurement m;
        if (kit_measure_times(&m, &scene, &(kit_way){ "tile-k", FM_FEED_TRIANGLES, ks[i] })) {
            const uint64_t pairs = (m.bytes_allocated - 48 - 268 * tiles) / 4 - 2;
            assert_int_equal(m.bytes_allocated, m.bytes_predicted);
            assert_int_equal(m.bytes_allocated, 4 * pairs + 4 * 2 + 268 * tiles + 48);
            assert_true(pairs >= tiles && pairs <= 2 * blocks); /* the diagonal's twice */
        }
        measurement_free(&m);
    }
    kit_scene_close(&scene);
    kit_close(&kit);
}

/* Layers whose corners lie on pixel borders leave no choice to a rasteriser: the host's truth is
 * the device's, fragment by fragment. */
static void host_and_device_agree_on_layers(void **state)
{
    static const char *const scenes[] = {
        "n=5 width_px=61 height_px=37 tessellation=3",
        "n=9 width_px=97 height_px=41 tessellation=16 order=random-cell fragment_probability=0.6",
        "n=4 width_px=33 height_px=90 tessellation=7 order=cell-major depths=ends pixel_density=1",
        "n=3 width_px=127 height_px=80 tessellation=64 depths=ulp",
        "n=1 width_px=4001 height_px=3 tessellation=1 depths=step24 pixel_density=1",
    };
    scene_kit kit;
    kit_open(&kit, device_of(state));
    for (size_t i = 0; i < sizeof scenes / sizeof scenes[0]; i++) {
        kit_scene scene;
        kit_scene_open(&scene, &kit, scenes[i]);
        const fm_truth *host = kit_truth(&scene, FM_FEED_TRIANGLES), *device = scene.truth;
        const size_t pixels = (size_t)host->width_px * host->height_px;
        assert_int_equal(host->fragment_count, device->fragment_count);
        assert_int_equal(host->n, device->n);
        assert_memory_equal(host->offsets, device->offsets, (pixels + 1) * sizeof(uint64_t));
        assert_memory_equal(host->fragments, device->fragments,
                            host->fragment_count * sizeof(fm_fragment));
        kit_scene_close(&scene);
    }
    kit_close(&kit);
}

/* Of a mesh the two differ where a corner lies within rounding of a subpixel's border: few pixels
 * get another number of fragments. */
static void host_and_device_nearly_agree_on_a_mesh(void **state)
{
    static const double share_allowed = 1e-3;
    scene_kit kit;
    kit_scene scene;
    uint64_t differ = 0;
    kit_open(&kit, device_of(state));
    kit_scene_open(&scene, &kit,
                   "generator=mesh mesh=/usr/share/glmark2/models/bunny.obj width_px=300 "
                   "height_px=300");
    const fm_truth *host = kit_truth(&scene, FM_FEED_TRIANGLES), *device = scene.truth;
    for (uint64_t i = 0; i < 300 * 300; i++)
        differ +=
            host->offsets[i + 1] - host->offsets[i] != device->offsets[i + 1] - device->offsets[i];
    print_message("bunny: %u of %u pixels have another number of fragments\n", (unsigned)differ,
                  (unsigned)host->nonempty_pixels);
    assert_true((double)differ <= share_allowed * (double)host->nonempty_pixels);
    kit_scene_close(&scene);
    kit_close(&kit);
}

/* As far as the guard band reaches, so that edges are as steep by pixel as they get. */
static void steep_edges_are_exact(void **state)
{
    static const struct {
        uint32_t width_px, height_px;
        float corners[3][2]; /* px */
    } steep[] = {
        { 64, 16, { { -32700, 32600 }, { 32500, -32600 }, { 32700, 32700 } } },
        { 16, 128, { { -32700, 60 }, { 32700, -32600 }, { 32700, 60 } } },
        { 64, 64, { { -32700, 32700 }, { 32700, -32650 }, { 32700, 32700 } } },
    };
    scene_kit kit;
    kit_open(&kit, device_of(state));
    for (size_t i = 0; i < sizeof steep / sizeof steep[0]; i++) {
        fm_scene *made = kit_quads_create(steep[i].width_px, steep[i].height_px, 1);
        kit_scene scene;
        made->triangles = 1;
        made->index_count = 3;
        for (int j = 0; j < 3; j++) {
            float *position = made->vertices[j].position;
            position[0] = 2 * steep[i].corners[j][0] / (float)steep[i].width_px - 1;
            position[1] = 2 * steep[i].corners[j][1] / (float)steep[i].height_px - 1;
            position[2] = 0.5f;
        }
        kit_scene_take(&scene, &kit, made);
        for (size_t j = 0; j < RASTERISER_COUNT; j++)
            expect_exact(&scene, &rasterisers[j], i);
        kit_scene_close(&scene);
    }
    kit_close(&kit);
}

/* No triangle, one that covers nothing, one over more tiles than a tile pass's group, and more
 * tiles than a dispatch has in a row. */
static void few_triangles_are_right(void **state)
{
    static const char *const scenes[] = {
        "n=0 width_px=20 height_px=20",
        "n=1 width_px=1 height_px=1 pixel_density=1 tessellation=1",
        "n=2 width_px=203 height_px=101 pixel_density=1 tessellation=1",
        "n=1 width_px=2049 height_px=1100 pixel_density=0.99 tessellation=1",
    };
    scene_kit kit;
    kit_open(&kit, device_of(state));
    for (size_t i = 0; i < sizeof scenes / sizeof scenes[0]; i++)
        for (size_t j = 0; j < RASTERISER_COUNT; j++) {
            kit_scene scene;
            kit_scene_open(&scene, &kit, scenes[i]);
            expect_exact(&scene, &rasterisers[j], i);
            kit_scene_close(&scene);
        }
    kit_close(&kit);
}

/* So deep that Mesa ends the loops of an invocation, whatever they are. */
static void what_is_lost_is_told(void **state)
{
    static const char *const ways[] = { "k=3000", "k=3000 chunk=alone",
                                        "k=300 structure=registers window=128" };
    scene_kit kit;
    kit_scene scene;
    kit_open(&kit, device_of(state));
    kit_scene_open(&scene, &kit, "n=3000 width_px=16 height_px=16 pixel_density=1 tessellation=1");
    for (size_t i = 0; i < sizeof ways / sizeof ways[0]; i++) {
        fm_measurement m;
        const kit_way way = { "tile-k", FM_FEED_TRIANGLES, ways[i] };
        if (kit_measure(&m, &scene, &way) && m.check.missing > 0)
            assert_true(m.lost > 0);
        measurement_free(&m);
    }
    kit_scene_close(&scene);
    kit_close(&kit);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        ON_VULKAN_AND_OSMESA(soups_are_rasterised_exactly),
        ON_VULKAN_AND_OSMESA(memory_does_not_depend_on_k),
        ON_VULKAN_AND_OSMESA(host_and_device_agree_on_layers),
        ON_VULKAN_AND_OSMESA(host_and_device_nearly_agree_on_a_mesh),
        ON_VULKAN_AND_OSMESA(steep_edges_are_exact),
        ON_VULKAN_AND_OSMESA(few_triangles_are_right),
        ON_VULKAN_AND_OSMESA(what_is_lost_is_told),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
