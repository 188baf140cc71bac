/* Every method on every feed and device: scenes worked out by hand, then scenes of all kinds
 * against truth. */
#include <math.h>
#include <stdio.h>

#include "base/text.h"
#include "kit/scene_kit.h"

/* What a picture may be off for rounding: float compositing of at most 64 layers against double. */
static const double image_tolerance = 1e-6;

enum { HAND_WIDTH = 5, HAND_HEIGHT = 4, HAND_PIXELS = HAND_WIDTH * HAND_HEIGHT, QUADS_MAX = 3 };

typedef struct hand_quad {
    fm_rect px;
    float depth;
    uint32_t colour;
} hand_quad;

/* Quads in order of arrival. */
typedef struct hand_scene {
    const char *name;
    hand_quad quads[QUADS_MAX];
    uint32_t quad_count;
} hand_scene;

/* Red in the low byte, premultiplied: half covering red, solid green, a quarter covering blue. */
#define RED   0x80000040u
#define GREEN 0xFF008000u
#define BLUE  0x40400000u

static const hand_scene hand_scenes[] = {
    { "one layer", { { { 0, 0, 5, 4 }, 0.5f, RED } }, 1 },
    { "two layers", { { { 0, 0, 5, 4 }, 0.5f, GREEN }, { { 1, 1, 4, 3 }, 0.25f, RED } }, 2 },
    { "three layers",
      { { { 0, 0, 5, 4 }, 0.5f, GREEN },
        { { 2, 0, 5, 4 }, 0.75f, BLUE },
        { { 1, 1, 4, 3 }, 0.0f, RED } },
      3 },
};
static const hand_scene depth_one = {
    "depth 1", { { { 0, 0, 5, 4 }, 1.0f, RED }, { { 1, 1, 4, 3 }, 0.5f, GREEN } }, 2
};

static fm_scene *make_by_hand(const hand_scene *hand)
{
    fm_scene *scene = kit_quads_create(HAND_WIDTH, HAND_HEIGHT, hand->quad_count);
    for (uint32_t i = 0; i < hand->quad_count; i++)
        kit_quad(scene, i, hand->quads[i].px, hand->quads[i].depth, hand->quads[i].colour);
    return scene;
}

/* The quads over a pixel, nearest first: what one would write down on paper. */
static uint32_t on_paper(const hand_quad *over[QUADS_MAX], const hand_scene *hand, uint32_t pixel)
{
    const uint32_t x = pixel % HAND_WIDTH, y = pixel / HAND_WIDTH;
    uint32_t count = 0;
    for (uint32_t i = 0; i < hand->quad_count; i++) {
        const hand_quad *quad = &hand->quads[i];
        if (x < quad->px.x0 || x >= quad->px.x1 || y < quad->px.y0 || y >= quad->px.y1)
            continue;
        uint32_t at = count++;
        for (; at > 0 && over[at - 1]->depth > quad->depth; at--)
            over[at] = over[at - 1];
        over[at] = quad;
    }
    return count;
}

/* The nearest `most` of them, seen from the back: each covers what is behind it. */
static void paint(double rgba[4], const hand_quad *const over[QUADS_MAX], uint32_t count,
                  uint32_t most)
{
    memset(rgba, 0, 4 * sizeof rgba[0]);
    for (uint32_t i = count < most ? count : most; i-- > 0;) {
        const uint32_t colour = over[i]->colour;
        const double shows = 1.0 - (double)(colour >> 24) / 255.0;
        for (int channel = 0; channel < 4; channel++)
            rgba[channel] =
                (double)(colour >> (8 * channel) & 0xFFu) / 255.0 + shows * rgba[channel];
    }
}

static void expect_truth(const fm_truth *truth, const hand_scene *hand)
{
    const hand_quad *over[QUADS_MAX];
    for (uint32_t pixel = 0; pixel < HAND_PIXELS; pixel++) {
        const uint32_t count = on_paper(over, hand, pixel);
        const fm_fragment *fragments = &truth->fragments[truth->offsets[pixel]];
        assert_int_equal(truth->offsets[pixel + 1] - truth->offsets[pixel], count);
        for (uint32_t i = 0; i < count; i++) {
            assert_memory_equal(&fragments[i].depth, &over[i]->depth, sizeof(float));
            assert_int_equal(fragments[i].colour, over[i]->colour);
        }
    }
}

static void expect_image(const fm_image *image, const hand_scene *hand, uint32_t most,
                         const char *where)
{
    const hand_quad *over[QUADS_MAX];
    double rgba[4];
    for (uint32_t pixel = 0; pixel < HAND_PIXELS; pixel++) {
        paint(rgba, over, on_paper(over, hand, pixel), most);
        for (uint32_t channel = 0; channel < 4; channel++) {
            const double is = (double)image->rgba[4 * pixel + channel];
            if (!(fabs(is - rgba[channel]) <= image_tolerance))
                fail_msg("%s: %s: pixel %u channel %u is %.9g, not %.9g", where, hand->name, pixel,
                         channel, is, rgba[channel]);
        }
    }
}

static void expect_exact(const fm_measurement *m, const char *where, const char *scene)
{
    const fm_check *check = &m->check;
    const bool holds = check->missing + check->extra + check->misordered + m->lost == 0;
    if (!holds)
        fail_msg("%s: %s: missing %u, extra %u, misordered %u, lost %u in %u pixels", where, scene,
                 (unsigned)check->missing, (unsigned)check->extra, (unsigned)check->misordered,
                 (unsigned)m->lost, (unsigned)check->wrong_pixels);
    const fm_accesses accesses = measure_accesses(m);
    if (accesses.outside > 0 || m->uncounted[0] != '\0')
        fail_msg("%s: %s: %u accesses out of range%s", where, scene, (unsigned)accesses.outside,
                 m->uncounted);
    if (!(m->self_max_abs <= image_tolerance))
        fail_msg("%s: %s: the image is %.3g from its fragments", where, scene, m->self_max_abs);
    if (!(m->error.region[FM_REGION_VIEWPORT].difference.max_abs <= image_tolerance))
        fail_msg("%s: %s: the image is %.3g from what truth allows", where, scene,
                 m->error.region[FM_REGION_VIEWPORT].difference.max_abs);
}

/* Which methods a scene meets, and on which feeds: compiling takes the time. */
typedef struct meeting {
    size_t scene;     /* its number: on one feed in turn */
    bool every_feed;  /* instead */
    bool every_third; /* of the methods, so that each meets four scenes in a row of twelve */
} meeting;

static bool is_its_turn(const meeting *turn, size_t method, uint32_t feed)
{
    const uint32_t one = (uint32_t)FM_FEED_RASTER << (turn->scene + method) % 4;
    if (turn->every_feed || kit_wants_all())
        return true;
    if (turn->every_third && (turn->scene / 4 + method) % 3 != 0)
        return false;
    return feed == one || (feed == FM_FEED_TRIANGLES && one == FM_FEED_RASTER);
}

/* Runs body for each method that hands over the right fragments, on each of its feeds or on that
 * whose turn it is with this scene. */
typedef void each_body(kit_scene *scene, const fm_method_desc *method, const kit_way *way,
                       const void *more);

static void on_each_right(kit_scene *scene, meeting turn, const char *texts, each_body *body,
                          const void *more)
{
    const bool any_ties = kit_has_ties(scene->truth);
    for (size_t i = 0; i < scene->kit->plugins.count; i++) {
        const fm_method_desc *method = kit_method(scene->kit, i);
        for (uint32_t feed = FM_FEED_RASTER; feed <= FM_FEED_TRIANGLES; feed <<= 1)
            if ((kit_feeds(method) & feed) != 0 && kit_is_right(method, any_ties) &&
                is_its_turn(&turn, i, feed))
                body(scene, method, &(kit_way){ method->id, feed, texts }, more);
    }
}

static void check_by_hand(kit_scene *scene, const fm_method_desc *method, const kit_way *way,
                          const void *more)
{
    const hand_scene *hand = more;
    fm_measurement m;
    char where[256];
    kit_tell(where, way);
    if (kit_measure(&m, scene, way)) {
        expect_exact(&m, where, hand->name);
        expect_image(m.image, hand, measure_wanted(method, strcmp(way->texts, "k=1") == 0 ? 1 : 2),
                     where);
    }
    measurement_free(&m);
}

static void methods_agree_with_paper_on_few_layers(void **state)
{
    scene_kit kit;
    kit_open(&kit, device_of(state));
    for (size_t i = 0; i < sizeof hand_scenes / sizeof hand_scenes[0]; i++) {
        kit_scene scene;
        kit_scene_take(&scene, &kit, make_by_hand(&hand_scenes[i]));
        expect_truth(scene.truth, &hand_scenes[i]);
        on_each_right(&scene, (meeting){ i, .every_feed = hand_scenes[i].quad_count == QUADS_MAX },
                      i == 0 ? "k=1" : "k=2", check_by_hand, &hand_scenes[i]);
        kit_scene_close(&scene);
    }
    kit_close(&kit);
}

/* Two layers as plain numbers: red 64/255 with alpha 128/255 before solid green 128/255. */
static void two_layers_mix_as_computed_by_head(void **state)
{
    static const float expected[4] = { 64.0f / 255, 128.0f / 255 * 127 / 255, 0.0f, 1.0f };
    scene_kit kit;
    kit_scene scene;
    fm_measurement m;
    kit_open(&kit, device_of(state));
    kit_scene_take(&scene, &kit, make_by_hand(&hand_scenes[1]));
    assert_true(kit_measure(&m, &scene, &(kit_way){ "kplus-array", FM_FEED_COMPUTE_PIXEL, "k=2" }));
    for (size_t channel = 0; channel < 4; channel++)
        assert_float_equal(m.image->rgba[4 * (HAND_WIDTH + 1) + channel], expected[channel], 1e-6f);
    measurement_free(&m);
    kit_scene_close(&scene);
    kit_close(&kit);
}

/* The layer at 1 is everywhere; before six of its pixels lies a nearer quad. */
static void check_depth_one(kit_scene *scene, const fm_method_desc *method, const kit_way *way,
                            const void *more)
{
    fm_measurement m;
    char where[256];
    (void)more;
    kit_tell(where, way);
    if (kit_measure(&m, scene, way)) {
        if ((method->traits & FM_TRAIT_LOSES_DEPTH_ONE) != 0) {
            const int behind = method->keeps == FM_KEEPS_NEAREST ? 6 : 0;
            assert_int_equal(m.check.missing, HAND_PIXELS - behind);
            m.check.missing = 0;
            m.error.region[FM_REGION_VIEWPORT].difference.max_abs =
                0; /* the picture lacks them, too */
        }
        expect_exact(&m, where, depth_one.name);
    }
    measurement_free(&m);
}

static void depth_one_is_lost_only_where_declared(void **state)
{
    scene_kit kit;
    kit_scene scene;
    kit_open(&kit, device_of(state));
    kit_scene_take(&scene, &kit, make_by_hand(&depth_one));
    expect_truth(scene.truth, &depth_one);
    on_each_right(&scene, (meeting){ 0 }, "k=2", check_depth_one, NULL);
    kit_scene_close(&scene);
    kit_close(&kit);
}

/* ---- against truth ---- */

static const struct random_scene {
    const char *texts, *k;
} random_scenes[] = {
    { "width_px=37 height_px=23 n=0", "k=3" },
    { "width_px=61 height_px=1 pixel_density=1 n=1 tessellation=2", "k=1" },
    { "width_px=37 height_px=23 pixel_density=0.6 n=4 tessellation=3 order=random-cell "
      "depths=clustered alphas=random",
      "k=5" },
    { "width_px=16 height_px=16 pixel_density=1 n=8 tessellation=4 order=descending depths=ulp",
      "k=8" },
    { "width_px=61 height_px=1 pixel_density=0.7 n=18 tessellation=5 order=cell-major "
      "depths=sloped seed=5",
      "k=17" },
    { "width_px=37 height_px=23 pixel_density=0.9 n=40 tessellation=7 order=random-cell "
      "depths=coplanar fragment_probability=0.5",
      "k=33" },
    { "width_px=1 height_px=61 pixel_density=1 n=40 tessellation=1 depths=sloped "
      "fragment_probability=0.5 seed=7",
      "k=2" },
    { "width_px=13 height_px=29 pixel_density=0.4 n=64 tessellation=6 order=ascending", "k=64" },
    { "width_px=19 height_px=11 pixel_density=1 n=40 order=cell-major tessellation=3 "
      "colours=grey",
      "k=64" },
    { "width_px=33 height_px=9 pixel_density=0.3 n=9 tessellation=2 depths=ulp "
      "fragment_probability=0.5",
      "k=8" },
    { "width_px=37 height_px=23 pixel_density=0.05 n=2 tessellation=1 depths=coplanar", "k=3" },
    { "width_px=29 height_px=31 pixel_density=0.5 n=40 tessellation=7 order=cell-major "
      "depths=clustered fragment_probability=0.5 seed=12",
      "k=1" },
};

static void expect_same_image(const fm_image *image, const fm_image *as, const kit_way *way,
                              const char *what)
{
    char where[256];
    kit_tell(where, way);
    if (image != NULL && as != NULL && !(kit_apart(image, as) <= image_tolerance))
        fail_msg("%s: %.3g from the image of %s", where, kit_apart(image, as), what);
}

static void check_random(kit_scene *scene, const fm_method_desc *method, const kit_way *way,
                         const void *more)
{
    const char *texts = more;
    fm_measurement m;
    char where[256];
    (void)method;
    kit_tell(where, way);
    if (kit_measure(&m, scene, way))
        expect_exact(&m, where, texts);
    measurement_free(&m);
}

static void methods_agree_with_truth_on_scenes_of_all_kinds(void **state)
{
    scene_kit kit;
    kit_open(&kit, device_of(state));
    for (size_t i = 0; i < sizeof random_scenes / sizeof random_scenes[0]; i++) {
        kit_scene scene;
        kit_scene_open(&scene, &kit, random_scenes[i].texts);
        on_each_right(&scene, (meeting){ i, .every_third = true }, random_scenes[i].k, check_random,
                      random_scenes[i].texts);
        kit_scene_close(&scene);
    }
    kit_close(&kit);
}

/* A method that keeps nothing must hand over nothing. */
static void null_hands_over_nothing(void **state)
{
    scene_kit kit;
    kit_scene scene;
    fm_measurement m;
    kit_open(&kit, device_of(state));
    kit_scene_open(&scene, &kit, "width_px=16 height_px=16 n=3");
    assert_true(kit_measure(&m, &scene, &(kit_way){ "null", FM_FEED_RASTER, "" }));
    assert_int_equal(m.check.captured, 0);
    assert_int_equal(m.lost, 0);
    measurement_free(&m);
    kit_scene_close(&scene);
    kit_close(&kit);
}

/* ---- options ---- */

#define OPTIONS_SCENE                                                                              \
    "width_px=23 height_px=17 pixel_density=0.8 n=9 tessellation=3 order=random-cell "             \
    "fragment_probability=0.5"

/* The way must give what truth has; a method that is not exact, what it gives by default. */
static void expect_as_default(kit_scene *scene, const fm_method_desc *method, uint32_t feed,
                              const fm_image *by_default, const char *texts)
{
    const kit_way way = { method->id, feed, texts };
    fm_measurement m;
    char where[256];
    kit_tell(where, &way);
    if (kit_measure(&m, scene, &way)) {
        /* A value 'published' is there for its errors: the image may stay right, depths not. */
        if (kit_is_right(method, false) && strstr(texts, "=published") == NULL)
            expect_exact(&m, where, OPTIONS_SCENE);
        /* Where a method chooses its k, its options say how much is wanted at all. */
        if (method->k_total == NULL &&
            (method->family != FM_FAMILY_CONTROL || (method->traits & FM_TRAIT_EXACT) != 0))
            expect_same_image(m.image, by_default, &way, "the default");
    }
    measurement_free(&m);
}

/* How many arrivals a pass keeps is which ones it keeps, where they do not come in order. */
static bool decides_what_is_kept(const fm_method_desc *method, const fm_option *option)
{
    bool is_samples = false;
    for (int i = 0; i < FM_MAX_RESOURCES && method->resources[i].name != NULL; i++)
        is_samples |= method->resources[i].samples_option != NULL &&
                      strcmp(method->resources[i].samples_option, option->name) == 0;
    return is_samples && (method->traits & FM_TRAIT_SORTED_INPUT) != 0;
}

/* There to damage what is stored, for hazard_test. */
static bool forges(const fm_option *option)
{
    return strcmp(option->name, "forge") == 0;
}

/* The first value is the default, which the others are compared with; of numbers the ends are
 * tried, since what lies between differs in nothing but size. */
static bool is_tried(const fm_option *option, int i)
{
    uint64_t number;
    const bool is_last = i + 1 == FM_MAX_OPTION_VALUES || option->values[i + 1] == NULL;
    return i == 1 || (i > 1 && (is_last || !text_to_u64(&number, option->values[i])));
}

/* Which of a method's values are tried: all, or every second one. */
typedef enum tried_values { EVEN, ODD, ALL } tried_values;

static void expect_own_options(kit_scene *scene, const fm_method_desc *method, uint32_t feed,
                               tried_values tried, const fm_image *by_default)
{
    char texts[160];
    size_t number = 0;
    for (const fm_option *option = method->options;
         option < method->options + FM_MAX_OPTIONS && option->name != NULL; option++)
        for (int i = 0; i < FM_MAX_OPTION_VALUES && option->values[i] != NULL &&
                        !decides_what_is_kept(method, option) && !forges(option);
             i++) {
            if (!is_tried(option, i) || (tried != ALL && number++ % 2 != tried))
                continue;
            snprintf(texts, sizeof texts, "k=4 %s=%s", option->name, option->values[i]);
            expect_as_default(scene, method, feed, by_default, texts);
        }
}

/* What a method without a lock gives where it races is chance, and so is the order of arrival but
 * on the raster feed of software, one thread a tile. */
static bool is_comparable(const scene_kit *kit, const fm_method_desc *method, uint32_t feed)
{
    const bool races = kit_races(kit, method, feed);
    if (races && feed == FM_FEED_RASTER)
        print_message("skipped: %s races on %s\n", method->id, kit->device->caps.name);
    return (kit_feeds(method) & feed) != 0 && !races &&
           ((feed == FM_FEED_RASTER && kit->device->caps.is_software) ||
            (method->traits & FM_TRAIT_SORTED_INPUT) == 0);
}

static void options_change_no_fragment(void **state)
{
    static const char *const ways[] = { "k=4 buffers=bound", "k=4 buffers=address",
                                        "k=4 full_screen=fragment", "k=4 pool=per-frame",
                                        "k=4 full_screen=fragment buffers=bound pool=per-frame" };
    static const uint32_t feeds[] = { FM_FEED_RASTER, FM_FEED_COMPUTE_LAYER };
    fm_device *device = device_of(state);
    const size_t is_vulkan = strcmp(device->ops->name, "vulkan") == 0;
    scene_kit kit;
    kit_scene scene;
    kit_open(&kit, device);
    kit_scene_open(&scene, &kit, OPTIONS_SCENE);
    for (size_t i = 0; i < 2 * kit.plugins.count; i++) {
        const fm_method_desc *method = kit_method(&kit, i / 2);
        const uint32_t feed = feeds[i % 2];
        fm_measurement m;
        /* Each pair of method and feed on one of both devices. */
        if (!is_comparable(&kit, method, feed) ||
            ((i / 2 + i) % 2 != is_vulkan && !kit_wants_all()))
            continue;
        if (kit_measure(&m, &scene, &(kit_way){ method->id, feed, "k=4" })) {
            const bool has_both = is_comparable(&kit, method, feeds[1 - i % 2]);
            expect_own_options(&scene, method, feed,
                               has_both && !kit_wants_all() ? (tried_values)(i % 2) : ALL, m.image);
            for (size_t way = 0; way < sizeof ways / sizeof ways[0]; way++)
                expect_as_default(&scene, method, feed, m.image, ways[way]);
        }
        measurement_free(&m);
    }
    kit_scene_close(&scene);
    kit_close(&kit);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        ON_VULKAN_AND_OSMESA(methods_agree_with_paper_on_few_layers),
        ON_VULKAN_AND_OSMESA(two_layers_mix_as_computed_by_head),
        ON_VULKAN_AND_OSMESA(depth_one_is_lost_only_where_declared),
        ON_VULKAN_AND_OSMESA(methods_agree_with_truth_on_scenes_of_all_kinds),
        ON_VULKAN_AND_OSMESA(options_change_no_fragment),
        ON_VULKAN_AND_OSMESA(null_hands_over_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
