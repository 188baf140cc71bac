/* The layers generator: rectangle, colours, orders, survival. */
#include "layers_kit.h"

static void assert_permutation(const uint32_t *row, uint32_t n)
{
    bool *seen = calloc(n, sizeof *seen);
    for (uint32_t i = 0; i < n; i++) {
        assert_true(row[i] < n && !seen[row[i]]);
        seen[row[i]] = true;
    }
    free(seen);
}

static void rect_of_a_quarter_of_854x480_is_427x240(void **state)
{
    (void)state;
    const fm_settings s = layers_settings(4);
    fm_scene *scene = create(&s);
    assert_int_equal(scene->rect.x1 - scene->rect.x0, 427);
    assert_int_equal(scene->rect.y1 - scene->rect.y0, 240);
    assert_int_equal(scene->rect.x0, 213);
    assert_int_equal(scene->rect.y0, 120);
    scene_destroy(scene);
}

static void rect_is_the_viewport_or_one_pixel_at_the_ends(void **state)
{
    (void)state;
    fm_settings s = layers_settings(4);
    s.pixel_density = 1.0;
    fm_scene *full = create(&s);
    assert_int_equal(full->rect.x1 - full->rect.x0, 854);
    assert_int_equal(full->rect.y1 - full->rect.y0, 480);
    s.pixel_density = 1e-9;
    fm_scene *tiny = create(&s);
    assert_int_equal(tiny->rect.x1 - tiny->rect.x0, 1);
    assert_int_equal(tiny->rect.y1 - tiny->rect.y0, 1);
    scene_destroy(full);
    scene_destroy(tiny);
}

static void no_layers_are_legal(void **state)
{
    (void)state;
    const fm_settings s = layers_settings(0);
    fm_scene *scene = create(&s);
    fm_fragment fragment;
    assert_null(scene->layers);
    assert_null(scene->order);
    assert_true(scene->triangles == 0);
    assert_int_equal(layers_fragments(&fragment, scene, 427, 240), 0);
    scene_destroy(scene);
}

static void layers_scene_has_no_mesh(void **state)
{
    (void)state;
    const fm_settings s = layers_settings(3);
    fm_scene *scene = create(&s);
    assert_null(scene->vertices);
    assert_null(scene->indices);
    assert_null(scene->clip_from_object);
    assert_true(scene->triangles == 2 * 4 * 4 * 3);
    assert_int_equal(strlen(scene->hash), 16);
    scene_destroy(scene);
}

static void uniform_depths_are_exact_and_below_one(void **state)
{
    (void)state;
    static const uint32_t counts[] = { 1, 2, 3, 4, 127, 128, 1000 };
    for (size_t c = 0; c < sizeof counts / sizeof counts[0]; c++) {
        const fm_settings s = layers_settings(counts[c]);
        fm_scene *scene = create(&s);
        int exponent = 0;
        while ((1u << exponent) <= counts[c])
            exponent++;
        for (uint32_t i = 0; i < counts[c]; i++)
            assert_true(ldexp((double)scene->layers[i].depth, exponent) == i + 1.0);
        assert_true(scene->layers[counts[c] - 1].depth < 1.0f);
        scene_destroy(scene);
    }
}

/* Whether two planes swap their order within the rectangle, tried at its corners. */
static bool cross(const fm_layer *a, const fm_layer *b)
{
    bool is_ahead = false, is_behind = false;
    for (int corner = 0; corner < 4; corner++) {
        const double x = corner & 1 ? 0.5 : -0.5, y = corner & 2 ? 0.5 : -0.5;
        const double difference = (double)(a->depth - b->depth) +
                                  x * (double)(a->slope_x - b->slope_x) +
                                  y * (double)(a->slope_y - b->slope_y);
        is_ahead = is_ahead || difference < 0.0;
        is_behind = is_behind || difference > 0.0;
    }
    return is_ahead && is_behind;
}

static void sloped_planes_stay_in_range_and_cross(void **state)
{
    (void)state;
    enum { N = 64 };
    fm_settings s = layers_settings(N);
    s.depths = FM_DEPTHS_SLOPED;
    fm_scene *scene = create(&s);
    uint32_t crossing = 0;
    for (uint32_t i = 0; i < N; i++) {
        const fm_layer *l = &scene->layers[i];
        const float reach = fabsf(l->slope_x) + fabsf(l->slope_y);
        assert_true(l->depth - reach >= 0.02f && l->depth + reach <= 0.98f);
        assert_true(i == 0 || scene->layers[i - 1].depth <= l->depth);
        for (uint32_t j = 0; j < i; j++)
            crossing += cross(l, &scene->layers[j]);
    }
    assert_true(crossing > N * (N - 1) / 2 * 9 / 10);
    scene_destroy(scene);
}

static void sloped_fragments_lie_on_their_plane(void **state)
{
    (void)state;
    fm_settings s = layers_settings(1);
    s.depths = FM_DEPTHS_SLOPED;
    fm_scene *scene = create(&s);
    fm_fragment left, right;
    assert_int_equal(layers_fragments(&left, scene, 300, 200), 1);
    assert_int_equal(layers_fragments(&right, scene, 301, 200), 1);
    const double step = (double)right.depth - (double)left.depth;
    /* Two roundings to floats below 1. */
    assert_true(fabs(step - (double)scene->layers[0].slope_x * 2.0 / 854.0) < 1.2e-7);
    scene_destroy(scene);
}

static void colours_are_premultiplied(void **state)
{
    (void)state;
    fm_settings s = layers_settings(256);
    s.alphas = FM_ALPHAS_RANDOM;
    s.alpha = 0.75;
    fm_scene *scene = create(&s);
    for (uint32_t i = 0; i < 256; i++) {
        const uint32_t colour = scene->layers[i].colour, alpha = colour >> 24;
        assert_in_range(alpha, 1, 191);
        for (int shift = 0; shift < 24; shift += 8)
            assert_true((colour >> shift & 0xFF) <= alpha);
    }
    scene_destroy(scene);
}

static void grey_of_half_alpha_is_known(void **state)
{
    (void)state;
    fm_settings s = layers_settings(2);
    s.colours = FM_COLOURS_GREY;
    fm_scene *scene = create(&s);
    /* a = round(0.5 * 255) = 128, (128 * 128 + 127) / 255 = 64 */
    assert_int_equal(scene->layers[0].colour, 0x80404040u);
    scene_destroy(scene);
}

static void cycle_repeats_after_eight_layers(void **state)
{
    (void)state;
    fm_settings s = layers_settings(16);
    s.colours = FM_COLOURS_CYCLE;
    fm_scene *scene = create(&s);
    for (uint32_t i = 0; i < 8; i++) {
        assert_int_equal(scene->layers[i].colour, scene->layers[i + 8].colour);
        assert_int_not_equal(scene->layers[i].colour, scene->layers[(i + 1) % 8].colour);
    }
    scene_destroy(scene);
}

static void orders_are_permutations(void **state)
{
    (void)state;
    static const fm_order orders[] = { FM_ORDER_RANDOM, FM_ORDER_RANDOM_CELL, FM_ORDER_ASCENDING,
                                       FM_ORDER_DESCENDING, FM_ORDER_CELL_MAJOR };
    for (size_t i = 0; i < sizeof orders / sizeof orders[0]; i++) {
        fm_settings s = layers_settings(33);
        s.order = orders[i];
        fm_scene *scene = create(&s);
        assert_int_equal(scene->order_rows, orders[i] == FM_ORDER_RANDOM_CELL ? 16 : 1);
        for (uint32_t row = 0; row < scene->order_rows; row++)
            assert_permutation(scene->order + row * 33, 33);
        scene_destroy(scene);
    }
}

static void ascending_and_descending_follow_depth(void **state)
{
    (void)state;
    fm_settings s = layers_settings(5);
    s.order = FM_ORDER_ASCENDING;
    fm_scene *up = create(&s);
    s.order = FM_ORDER_DESCENDING;
    fm_scene *down = create(&s);
    for (uint32_t i = 0; i < 5; i++) {
        assert_int_equal(up->order[i], i);
        assert_int_equal(down->order[i], 4 - i);
    }
    scene_destroy(up);
    scene_destroy(down);
}

static void same_seed_same_scene_other_seed_other_order(void **state)
{
    (void)state;
    fm_settings s = layers_settings(32);
    fm_scene *a = create(&s), *b = create(&s);
    s.seed = 8;
    fm_scene *c = create(&s);
    assert_memory_equal(a->order, b->order, 32 * sizeof(uint32_t));
    assert_memory_equal(a->layers, b->layers, 32 * sizeof(fm_layer));
    assert_memory_not_equal(a->order, c->order, 32 * sizeof(uint32_t));
    scene_destroy(a);
    scene_destroy(b);
    scene_destroy(c);
}

static void random_cell_orders_differ_from_cell_to_cell(void **state)
{
    (void)state;
    fm_settings s = layers_settings(32);
    s.order = FM_ORDER_RANDOM_CELL;
    fm_scene *scene = create(&s);
    assert_memory_not_equal(scene->order, scene->order + 32, 32 * sizeof(uint32_t));
    /* The pixel just left and just right of the border between cells 1 and 2 of row 3. */
    const uint32_t x = layers_border(scene->rect.x0, scene->rect.x1, 2, 4), y = scene->rect.y1 - 1;
    fm_fragment fragments[32];
    for (uint32_t side = 0; side < 2; side++) {
        assert_int_equal(layers_fragments(fragments, scene, x - 1 + side, y), 32);
        const uint32_t *row = scene->order + (3 * 4 + 1 + side) * 32;
        for (uint32_t i = 0; i < 32; i++)
            assert_true(fragments[i].depth == scene->layers[row[i]].depth);
    }
    scene_destroy(scene);
}

static void borders_are_whole_and_cover_the_rectangle(void **state)
{
    (void)state;
    for (uint32_t t = 1; t <= 64; t++)
        for (uint32_t size = 1; size < 100; size++) {
            assert_int_equal(layers_border(10, 10 + size, 0, t), 10);
            assert_int_equal(layers_border(10, 10 + size, t, t), 10 + size);
            for (uint32_t i = 0; i < t; i++)
                assert_true(layers_border(10, 10 + size, i, t) <=
                            layers_border(10, 10 + size, i + 1, t));
        }
}

/* Fewer pixels than cells: some cells are empty, and each pixel still finds its own. */
static void random_cell_works_with_empty_cells(void **state)
{
    (void)state;
    fm_settings s = layers_settings(3);
    s.width_px = s.height_px = 9;
    s.pixel_density = 1.0;
    s.tessellation = 64;
    s.order = FM_ORDER_RANDOM_CELL;
    fm_scene *scene = create(&s);
    fm_fragment fragments[3];
    for (uint32_t i = 0; i < 81; i++)
        assert_int_equal(layers_fragments(fragments, scene, i % 9, i / 9), 3);
    scene_destroy(scene);
}

static void random_cell_too_large_is_refused_before_allocating(void **state)
{
    (void)state;
    fm_settings s = layers_settings(1u << 20);
    s.order = FM_ORDER_RANDOM_CELL;
    s.tessellation = 64;
    fm_scene *scene;
    fm_error err;
    assert_int_equal(scene_create(&scene, &s, &err), FM_NO_MEMORY);
    assert_null(scene);
    assert_non_null(strstr(err.message, "random-cell"));
}

static void more_layers_than_depths_are_refused(void **state)
{
    (void)state;
    fm_settings s = layers_settings(8u << 17);
    s.depths = FM_DEPTHS_CLUSTERED;
    fm_scene *scene;
    fm_error err;
    assert_int_equal(scene_create(&scene, &s, &err), FM_INVALID);
    assert_null(scene);
}

static void pixels_outside_the_rectangle_are_empty(void **state)
{
    (void)state;
    const fm_settings s = layers_settings(4);
    fm_scene *scene = create(&s);
    fm_fragment fragments[4];
    assert_int_equal(layers_fragments(fragments, scene, 212, 240), 0);
    assert_int_equal(layers_fragments(fragments, scene, 213, 240), 4);
    assert_int_equal(layers_fragments(fragments, scene, 639, 240), 4);
    assert_int_equal(layers_fragments(fragments, scene, 640, 240), 0);
    assert_int_equal(layers_fragments(fragments, scene, 400, 119), 0);
    assert_int_equal(layers_fragments(fragments, scene, 400, 360), 0);
    scene_destroy(scene);
}

/* A copy of the contract in scene.h, not of the code. */
static bool documented_survival(const fm_scene *scene, uint32_t x, uint32_t y, uint32_t layer)
{
    const uint64_t seed = scene->settings.seed;
    const uint32_t seed32 = (uint32_t)(seed ^ seed >> 32);
    uint32_t h = x + y * 0x9E3779B1u + layer * 0x85EBCA77u + seed32 * 0xC2B2AE3Du;
    h ^= h >> 16;
    h *= 0x7FEB352Du;
    h ^= h >> 15;
    h *= 0x846CA68Bu;
    h ^= h >> 16;
    return h < scene->survival_threshold;
}

static void survival_follows_the_documented_hash(void **state)
{
    (void)state;
    fm_settings s = layers_settings(16);
    s.fragment_probability = 0.25;
    s.order = FM_ORDER_ASCENDING;
    s.seed = UINT64_C(0x123456789ABCDEF0);
    fm_scene *scene = create(&s);
    assert_int_equal(scene->survival_threshold, 0x40000000u);
    fm_fragment fragments[16];
    uint64_t total = 0;
    for (uint32_t y = 200; y < 300; y++)
        for (uint32_t x = 300; x < 400; x++) {
            const uint32_t count = layers_fragments(fragments, scene, x, y);
            uint32_t next = 0;
            for (uint32_t layer = 0; layer < 16; layer++)
                if (documented_survival(scene, x, y, layer)) {
                    assert_true(next < count);
                    assert_true(fragments[next].depth == scene->layers[layer].depth);
                    assert_true(fragments[next].colour == scene->layers[layer].colour);
                    next++;
                }
            assert_int_equal(next, count);
            total += count;
        }
    /* 160 000 fragments, six standard deviations are 1040. */
    assert_in_range(total, 40000 - 1040, 40000 + 1040);
    scene_destroy(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rect_of_a_quarter_of_854x480_is_427x240),
        cmocka_unit_test(rect_is_the_viewport_or_one_pixel_at_the_ends),
        cmocka_unit_test(no_layers_are_legal),
        cmocka_unit_test(layers_scene_has_no_mesh),
        cmocka_unit_test(uniform_depths_are_exact_and_below_one),
        cmocka_unit_test(sloped_planes_stay_in_range_and_cross),
        cmocka_unit_test(sloped_fragments_lie_on_their_plane),
        cmocka_unit_test(colours_are_premultiplied),
        cmocka_unit_test(grey_of_half_alpha_is_known),
        cmocka_unit_test(cycle_repeats_after_eight_layers),
        cmocka_unit_test(orders_are_permutations),
        cmocka_unit_test(ascending_and_descending_follow_depth),
        cmocka_unit_test(same_seed_same_scene_other_seed_other_order),
        cmocka_unit_test(random_cell_orders_differ_from_cell_to_cell),
        cmocka_unit_test(borders_are_whole_and_cover_the_rectangle),
        cmocka_unit_test(random_cell_works_with_empty_cells),
        cmocka_unit_test(random_cell_too_large_is_refused_before_allocating),
        cmocka_unit_test(more_layers_than_depths_are_refused),
        cmocka_unit_test(pixels_outside_the_rectangle_are_empty),
        cmocka_unit_test(survival_follows_the_documented_hash),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
