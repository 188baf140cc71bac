/* Pixels so deep that a device ends the loops of an invocation that sorts, compares or feeds all of
 * their fragments at once: Mesa's software rasterisers do so after 65 535 iterations. Every method
 * that hands over exactly the wanted fragments does so there, too. Each scene meets every third
 * method, in turn, on one feed, in turn; FRAGMARK_TEST_ALL=1: every method, around every bound. */
#include <stdio.h>

#include "kit/scene_kit.h"
#include "random_kit.h"

enum { FEEDS = 5, METHODS_APART = 3 };
static const uint32_t feeds[FEEDS] = { FM_FEED_RASTER, FM_FEED_COMPUTE_ADJACENT,
                                       FM_FEED_COMPUTE_LAYER, FM_FEED_COMPUTE_PIXEL,
                                       FM_FEED_TRIANGLES };

/* Peeling takes a pass over all layers for each layer: the time is the square of n. */
static bool is_judged(const fm_method_desc *method, const kit_scene *scene)
{
    return kit_is_right(method, kit_has_ties(scene->truth)) &&
           (method->family != FM_FAMILY_PEELING || scene->scene->n < 1000);
}

/* Its window of fragments lives in registers: what a round needs cannot outlive a run. */
static bool may_reach_the_limit(const kit_way *way)
{
    return strcmp(way->method, "tile-k") == 0;
}

/* Exact, or not supported for another reason than the loops. */
static void expect_exact(kit_scene *scene, const kit_way *way)
{
    fm_measurement m;
    fm_error err = { .message = "" };
    char where[256];
    kit_tell(where, way);
    const fm_status status = kit_try(&m, scene, way, true, &err);
    if (status != FM_OK &&
        (status != FM_UNSUPPORTED || (err.reason == FM_REASON_LOOPS && !may_reach_the_limit(way))))
        fail_msg("n = %u, %s: %s", scene->scene->n, where, err.message);
    if (status == FM_OK && m.check.missing + m.check.extra + m.check.misordered + m.lost != 0)
        fail_msg("n = %u, %s: missing %u, extra %u, misordered %u, lost %u", scene->scene->n, where,
                 (unsigned)m.check.missing, (unsigned)m.check.extra, (unsigned)m.check.misordered,
                 (unsigned)m.lost);
    measurement_free(&m);
}

/* Feed `turn`, or the next that the method takes. */
static uint32_t feed_in_turn(const fm_method_desc *method, size_t turn)
{
    uint32_t feed = 0;
    for (size_t i = turn; i < turn + FEEDS && feed == 0; i++)
        feed = kit_feeds(method) & feeds[i % FEEDS];
    return feed;
}

static void expect_all_exact(kit_scene *scene, const char *texts, size_t turn)
{
    const scene_kit *kit = scene->kit;
    for (size_t at = 0; at < kit->plugins.count; at++) {
        const fm_method_desc *method = kit_method(kit, at);
        const uint32_t feed = feed_in_turn(method, at + turn);
        if (is_judged(method, scene) && feed != 0 &&
            (kit_wants_all() || at % METHODS_APART == turn % METHODS_APART))
            expect_exact(scene, &(kit_way){ method->id, feed, texts });
    }
}

typedef struct depth_case {
    uint32_t n, k;
} depth_case;

static void expect_case(scene_kit *kit, depth_case c, const char *layers, size_t turn)
{
    char texts[256], key[32];
    kit_scene scene;
    snprintf(key, sizeof key, "k=%u", c.k);
    snprintf(texts, sizeof texts,
             "width_px=1 height_px=1 pixel_density=1 tessellation=1 alpha=0.001 n=%u k=%u %s", c.n,
             c.k, layers);
    kit_scene_open(&scene, kit, texts);
    expect_all_exact(&scene, key, turn);
    kit_scene_close(&scene);
}

static void one_deep_pixel_is_exact(void **state)
{
    static const depth_case some[] = { { 5000, 40 }, { 1500, 1100 } };
    static const depth_case all[] = {
        { 362, 362 },    { 640, 50 },     { 1024, 256 },  { 1024, 1024 }, { 2047, 1023 },
        { 2048, 1022 },  { 2049, 13 },    { 4095, 4096 }, { 4096, 4095 }, { 4097, 4096 },
        { 5000, 8 },     { 12000, 4096 }, { 12000, 8 },   { 21844, 1 },   { 21845, 2 },
        { 21846, 3 },    { 32768, 1000 }, { 65534, 17 },  { 65535, 1 },   { 65536, 8 },
        { 65536, 4096 },
    };
    scene_kit kit;
    const bool wants_all = kit_wants_all();
    const depth_case *cases = wants_all ? all : some;
    kit_open(&kit, device_of(state));
    for (size_t i = 0; i < (wants_all ? sizeof all : sizeof some) / sizeof *cases; i++)
        expect_case(&kit, cases[i], i % 2 == 0 ? "order=random" : "order=descending", i);
    kit_close(&kit);
}

/* Where a driver ends loops they are sorted by their links, in several runs. */
static void deep_lists_of_any_nodes_are_exact(void **state)
{
    static const char *const methods[] = { "ab-ll", "ab-ll-bucket", "kb-ab-ll" };
    static const char *const texts[] = { "k=40 node=split", "k=40 node=whole" };
    scene_kit kit;
    kit_scene scene;
    kit_open(&kit, device_of(state));
    kit_scene_open(&scene, &kit,
                   "width_px=2 height_px=1 pixel_density=1 tessellation=1 alpha=0.001 n=5000");
    for (size_t i = 0; i < 2 * sizeof methods / sizeof methods[0]; i++)
        expect_exact(&scene, &(kit_way){ methods[i / 2], FM_FEED_RASTER, texts[i % 2] });
    kit_scene_close(&scene);
    kit_close(&kit);
}

static void pixels_of_any_depth_are_exact(void **state)
{
    static const char *const orders[] = { "order=random depths=coplanar", "order=ascending",
                                          "order=descending fragment_probability=0.9" };
    enum { CASES = 12 };
    scene_kit kit;
    uint64_t random = 7;
    kit_open(&kit, device_of(state));
    for (size_t i = 0; i < CASES && kit_wants_all(); i++) {
        const depth_case c = { draw_in(&random, 300, 20000), draw_in(&random, 1, 4096) };
        expect_case(&kit, c, orders[i % 3], i);
    }
    kit_close(&kit);
}

/* Whoever counts loops and stops before the limit loses nothing that the method could have kept. */
static void a_shader_that_stops_in_time_is_not_wrong(void **state)
{
    scene_kit kit;
    kit_scene scene;
    kit_open(&kit, device_of(state));
    kit_scene_open(&scene, &kit,
                   "width_px=8 height_px=6 pixel_density=0.5 tessellation=1 alpha=0.01 n=65536 "
                   "fragment_probability=0.06");
    expect_exact(&scene, &(kit_way){ "tile-k", FM_FEED_TRIANGLES, "k=40" });
    kit_scene_close(&scene);
    kit_close(&kit);
}

/* What most meshes have: a deep pixel among shallow and empty ones, which share its loops. */
static void a_deep_pixel_among_shallow_ones_is_exact(void **state)
{
    enum { WIDTH = 19, HEIGHT = 3, DEEP = 3000, QUADS = DEEP + 4 };
    scene_kit kit;
    kit_scene scene;
    uint64_t random = 3;
    fm_scene *made = kit_quads_create(WIDTH, HEIGHT, QUADS);
    for (uint32_t i = 0; i < QUADS; i++) {
        const fm_rect all = { 0, 0, WIDTH - 3, HEIGHT }, one = { 5, 1, 6, 2 };
        kit_quad(made, i, i % (QUADS / 4) == 0 ? all : one, draw_real(&random, 0.1f, 0.9f),
                 0x01020304u * (i % 60 + 1));
    }
    kit_open(&kit, device_of(state));
    kit_scene_take(&scene, &kit, made);
    expect_all_exact(&scene, "k=30", 2);
    kit_scene_close(&scene);
    kit_close(&kit);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        ON_VULKAN_AND_OSMESA(one_deep_pixel_is_exact),
        ON_VULKAN_AND_OSMESA(deep_lists_of_any_nodes_are_exact),
        ON_VULKAN_AND_OSMESA(pixels_of_any_depth_are_exact),
        ON_VULKAN_AND_OSMESA(a_shader_that_stops_in_time_is_not_wrong),
        ON_VULKAN_AND_OSMESA(a_deep_pixel_among_shallow_ones_is_exact),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
