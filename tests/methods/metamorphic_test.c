/* What must not change an image of an exact method, and what may change it in one way only: quads
 * drawn in another order, lying elsewhere in memory or in the tiles, with more behind the k-th, and
 * with other k. Half of the scenes have ties. A part of the methods on few scenes, unless all are
 * asked for (FRAGMARK_TEST_ALL). */
#include <math.h>
#include <stdio.h>

#include "kit/scene_kit.h"
#include "random_kit.h"
#include "truth/reference.h"

enum {
    FULL = 4, /* quads over all of the picture, before depth 1/2: at least so many a pixel */
    QUADS = 14,
    BEHIND = 6, /* further ones, behind depth 1/2 */
    WIDTH = 11,
    HEIGHT = 6,
    SCENES = 4, /* where all are asked for */
    PART = 9,   /* of the methods, in turn */
    VALUES = FM_MAX_OPTION_VALUES
};

typedef struct random_quad {
    fm_rect px;
    float depth;
    uint32_t colour;
} random_quad;

typedef struct quad_list {
    random_quad quads[QUADS + BEHIND];
    uint32_t count;
    uint32_t width_px, height_px, dx, dy; /* of the viewport, and where the picture lies in it */
} quad_list;

static uint32_t draw_colour(uint64_t *state)
{
    const uint32_t alpha = draw_in(state, 1, 255);
    return draw_in(state, 0, alpha) | draw_in(state, 0, alpha) << 8 |
           draw_in(state, 0, alpha) << 16 | alpha << 24;
}

static fm_rect draw_rect(uint64_t *state)
{
    const uint32_t x0 = draw_in(state, 0, WIDTH - 1), y0 = draw_in(state, 0, HEIGHT - 1);
    return (fm_rect){ x0, y0, draw_in(state, x0 + 1, WIDTH), draw_in(state, y0 + 1, HEIGHT) };
}

static void shuffle(quad_list *list, uint64_t *state)
{
    for (uint32_t i = list->count; i > 1; i--) {
        const uint32_t other = draw_in(state, 0, i - 1);
        const random_quad last = list->quads[i - 1];
        list->quads[i - 1] = list->quads[other];
        list->quads[other] = last;
    }
}

/* Depths are all different, or three quads share each. */
static void draw_list(quad_list *list, uint32_t number)
{
    uint64_t state = 0x3E7A0000u + number;
    const uint32_t alike = number % 2 == 0 ? 1 : 3;
    *list = (quad_list){ .count = QUADS, .width_px = WIDTH, .height_px = HEIGHT };
    for (uint32_t i = 0; i < QUADS; i++) {
        const float depth = (float)(i / alike + 1) / 32;
        list->quads[i] = (random_quad){ draw_rect(&state), depth, draw_colour(&state) };
        if (i < FULL)
            list->quads[i].px = (fm_rect){ 0, 0, WIDTH, HEIGHT };
    }
    shuffle(list, &state);
}

static void open_list(kit_scene *scene, scene_kit *kit, const quad_list *list)
{
    fm_scene *made = kit_quads_create(list->width_px, list->height_px, list->count);
    for (uint32_t i = 0; i < list->count; i++) {
        const random_quad *quad = &list->quads[i];
        const fm_rect px = { quad->px.x0 + list->dx, quad->px.y0 + list->dy, quad->px.x1 + list->dx,
                             quad->px.y1 + list->dy };
        kit_quad(made, i, px, quad->depth, quad->colour);
    }
    kit_scene_take(scene, kit, made);
}

/* The image that a method draws; NULL: not supported, or it chose another k. */
static fm_image *picture(kit_scene *scene, const fm_method_desc *method, const char *texts)
{
    const kit_way way = { method->id, FM_FEED_RASTER, texts };
    fm_image *image = NULL;
    fm_measurement m;
    if (kit_measure_times(&m, scene, &way) && m.k_chosen == 0) {
        image = m.image;
        m.image = NULL;
    }
    measurement_free(&m);
    return image;
}

/* What truth allows of the wanted fragments; where no ties leave it open, `apart` at most from the
 * other image, too. */
static void expect_same(kit_scene *scene, fm_image *image, const fm_image *other, uint32_t wanted,
                        double apart, const kit_way *way)
{
    char where[256];
    double off = 0;
    fm_error err = { .message = "" };
    fm_image *const images[] = { image };
    const reference_images compared = {
        .truth = scene->truth, .wanted = wanted, .images = images, .count = 1
    };
    kit_tell(where, way);
    if (reference_distance(&off, &compared, &err) != FM_OK)
        fail_msg("%s", err.message);
    if (!(off <= image_rounding(scene->truth->n)))
        fail_msg("%s: %.3g from what truth allows", where, off);
    if (truth_tied_pixels(scene->truth, wanted) == 0 && !(kit_apart(image, other) <= apart))
        fail_msg("%s: %.3g from the other image", where, kit_apart(image, other));
}

/* A scene, and for each method of its part: body. */
typedef void each_method(kit_scene *scene, const quad_list *list, const fm_method_desc *method);

static bool is_its_turn(size_t method, uint32_t number, uint32_t relation)
{
    return kit_wants_all() || (method + 4 * number + relation) % PART == 0;
}

static void on_each_exact(void **state, uint32_t relation, each_method *body)
{
    scene_kit kit;
    unsigned seen = 0;
    kit_open(&kit, device_of(state));
    const uint32_t few = strcmp(kit.device->ops->name, "vulkan") == 0 ? 2 : 1;
    for (uint32_t number = 0; number < (kit_wants_all() ? SCENES : few); number++) {
        quad_list list;
        kit_scene scene;
        draw_list(&list, number);
        open_list(&scene, &kit, &list);
        for (size_t i = 0; i < kit.plugins.count; i++) {
            const fm_method_desc *method = kit_method(&kit, i);
            if ((method->traits & FM_TRAIT_EXACT) == 0 ||
                (kit_feeds(method) & FM_FEED_RASTER) == 0 || !is_its_turn(i, number, relation))
                continue;
            body(&scene, &list, method);
            seen++;
        }
        kit_scene_close(&scene);
    }
    kit_close(&kit);
    assert_true(seen > 0);
}

static void expect_any_order(kit_scene *scene, const quad_list *list, const fm_method_desc *method)
{
    const kit_way way = { method->id, FM_FEED_RASTER, "k=5, another order" };
    uint64_t state = 5;
    quad_list other = *list;
    kit_scene permuted;
    shuffle(&other, &state);
    open_list(&permuted, scene->kit, &other);
    fm_image *first = picture(scene, method, "k=5"), *second = picture(&permuted, method, "k=5");
    if (first != NULL && second != NULL)
        expect_same(scene, second, first, measure_wanted(method, 5), 0, &way);
    image_destroy(first);
    image_destroy(second);
    kit_scene_close(&permuted);
}

static void order_of_drawing_changes_nothing(void **state)
{
    on_each_exact(state, 0, expect_any_order);
}

/* Each value against the first. */
static void expect_any_value(kit_scene *scene, const fm_method_desc *method, const char *name)
{
    const fm_option *option = option_find(method, name);
    fm_image *first = NULL;
    for (int i = 0; option != NULL && i < VALUES && option->values[i] != NULL; i++) {
        char texts[64];
        snprintf(texts, sizeof texts, "k=5 %s=%s", name, option->values[i]);
        const kit_way way = { method->id, FM_FEED_RASTER, texts };
        fm_image *image = picture(scene, method, texts);
        if (image != NULL && first != NULL)
            expect_same(scene, image, first, measure_wanted(method, 5), image_rounding(QUADS),
                        &way);
        if (first == NULL)
            first = image;
        else
            image_destroy(image);
    }
    image_destroy(first);
}

static void expect_any_memory(kit_scene *scene, const quad_list *list, const fm_method_desc *method)
{
    (void)list;
    for (size_t i = 0; i < AUTO_OPTION_COUNT; i++)
        expect_any_value(scene, method, auto_options[i].name);
}

static void layout_in_memory_changes_nothing(void **state)
{
    on_each_exact(state, 0, expect_any_memory);
}

/* The picture out of a larger one. */
static fm_image *cut_out(const fm_image *from, uint32_t dx, uint32_t dy)
{
    fm_image *image;
    fm_error err = { .message = "" };
    if (image_create(&image, WIDTH, HEIGHT, &err) != FM_OK)
        fail_msg("%s", err.message);
    for (uint32_t y = 0; y < HEIGHT; y++)
        memcpy(&image->rgba[4ull * WIDTH * y],
               &from->rgba[4ull * ((uint64_t)from->width_px * (y + dy) + dx)],
               4ull * WIDTH * sizeof(float));
    return image;
}

/* Elsewhere in a larger viewport, borders of tiles cross the picture at other places. */
static void expect_moved(kit_scene *scene, const quad_list *list, const fm_method_desc *method)
{
    const kit_way way = { method->id, FM_FEED_RASTER, "k=5, moved" };
    quad_list other = *list;
    kit_scene moved;
    other.width_px = 23;
    other.height_px = 17;
    other.dx = 7;
    other.dy = 5;
    open_list(&moved, scene->kit, &other);
    fm_image *first = picture(scene, method, "k=5"), *second = picture(&moved, method, "k=5");
    if (first != NULL && second != NULL) {
        fm_image *cut = cut_out(second, other.dx, other.dy);
        expect_same(scene, cut, first, measure_wanted(method, 5), image_rounding(QUADS), &way);
        image_destroy(cut);
    }
    image_destroy(first);
    image_destroy(second);
    kit_scene_close(&moved);
}

static void place_among_tiles_changes_nothing(void **state)
{
    on_each_exact(state, 1, expect_moved);
}

/* Every pixel has FULL fragments before them. They arrive in between. */
static void expect_nothing_behind(kit_scene *scene, const quad_list *list,
                                  const fm_method_desc *method)
{
    const kit_way way = { method->id, FM_FEED_RASTER, "k=4, more behind" };
    const uint32_t wanted = measure_wanted(method, FULL);
    uint64_t state = 9;
    quad_list other = *list;
    kit_scene more;
    if (wanted > FULL)
        return;
    for (; other.count < QUADS + BEHIND; other.count++)
        other.quads[other.count] =
            (random_quad){ draw_rect(&state), (float)(other.count + 1) / 64 + 0.5f,
                           draw_colour(&state) };
    shuffle(&other, &state);
    open_list(&more, scene->kit, &other);
    fm_image *first = picture(scene, method, "k=4"), *second = picture(&more, method, "k=4");
    if (first != NULL && second != NULL)
        expect_same(scene, second, first, wanted, image_rounding(QUADS), &way);
    image_destroy(first);
    image_destroy(second);
    kit_scene_close(&more);
}

static void what_lies_behind_the_kth_changes_nothing(void **state)
{
    on_each_exact(state, 2, expect_nothing_behind);
}

static void expect_a_buffer(kit_scene *scene, const quad_list *list, const fm_method_desc *method)
{
    (void)list;
    static const char *const texts[] = { "k=14", "k=17" };
    const fm_plugin_entry *all = plugin_list_find(&scene->kit->plugins, "exact");
    if (!plugin_has_k(method) || all == NULL)
        return;
    assert_true(scene->truth->n <= QUADS);
    fm_image *a_buffer = picture(scene, all->plugin->method, "");
    for (size_t i = 0; i < sizeof texts / sizeof texts[0] && a_buffer != NULL; i++) {
        const kit_way way = { method->id, FM_FEED_RASTER, texts[i] };
        fm_image *image = picture(scene, method, texts[i]);
        if (image != NULL)
            expect_same(scene, image, a_buffer, UINT32_MAX, image_rounding(QUADS), &way);
        image_destroy(image);
    }
    image_destroy(a_buffer);
}

static void k_of_n_or_more_is_an_a_buffer(void **state)
{
    on_each_exact(state, 3, expect_a_buffer);
}

/* Of all fragments: squared error, summed over the image. */
static double truncation(const fm_image *image, const fm_truth *truth)
{
    double sum = 0;
    for (uint64_t i = 0; i < (uint64_t)truth->width_px * truth->height_px; i++) {
        double all[4];
        composite_pixel(all, &truth->fragments[truth->offsets[i]],
                        truth->offsets[i + 1] - truth->offsets[i]);
        for (uint64_t c = 0; c < 4; c++)
            sum += pow(all[c] - (double)image->rgba[4 * i + c], 2);
    }
    return sum;
}

/* Each further fragment adds colour that is not negative, so that no channel moves away. Where
 * depths tie, the k nearest may be others than some of the k + 1 nearest. */
static void expect_falling_truncation(kit_scene *scene, const quad_list *list,
                                      const fm_method_desc *method)
{
    (void)list;
    const double rounding = 1e-6;
    double before = INFINITY;
    if (!plugin_has_k(method) || kit_has_ties(scene->truth))
        return;
    for (uint32_t k = 1; k <= QUADS; k = kit_wants_all() ? k + 1 : 3 * k - 1) { /* 1, 2, 5, 14 */
        char texts[32];
        snprintf(texts, sizeof texts, "k=%u", k);
        fm_image *image = picture(scene, method, texts);
        if (image == NULL)
            return;
        const double now = sqrt(truncation(image, scene->truth));
        if (!(now <= before + rounding))
            fail_msg("%s, %s: %.6g, and %.6g with the k before", method->id, texts, now, before);
        before = now;
        image_destroy(image);
    }
    if (!(before <= rounding * QUADS))
        fail_msg("%s: %.6g is left with k = n", method->id, before);
}

static void truncation_never_grows_with_k(void **state)
{
    on_each_exact(state, 4, expect_falling_truncation);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        ON_VULKAN_AND_OSMESA(order_of_drawing_changes_nothing),
        ON_VULKAN_AND_OSMESA(layout_in_memory_changes_nothing),
        ON_VULKAN_AND_OSMESA(place_among_tiles_changes_nothing),
        ON_VULKAN_AND_OSMESA(what_lies_behind_the_kth_changes_nothing),
        ON_VULKAN_AND_OSMESA(k_of_n_or_more_is_an_a_buffer),
        ON_VULKAN_AND_OSMESA(truncation_never_grows_with_k),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
