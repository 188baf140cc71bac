/* The host's rasteriser: coverage worked out by hand, shared edges, clipping, depth. */
#include <math.h>

#include "base/random.h"
#include "device/device_kit.h"
#include "scene/rasterise.h"

enum { WIDTH = 16, HEIGHT = 8, PIXEL_COUNT = WIDTH * HEIGHT };

typedef struct drawn_pixels {
    uint32_t hits[PIXEL_COUNT];
    float depth[PIXEL_COUNT];
} drawn;

static void note(void *context, uint32_t x, uint32_t y, float depth)
{
    drawn *to = context;
    assert_true(x < WIDTH && y < HEIGHT);
    to->hits[y * WIDTH + x]++;
    to->depth[y * WIDTH + x] = depth;
}

static void rasterise(drawn *to, const fm_clip_corner corners[3])
{
    const fm_raster_target target = { WIDTH, HEIGHT, 0, HEIGHT, note, to };
    rasterise_triangle(&target, corners);
}

/* A corner at a place in pixels. */
static fm_clip_corner at(float x, float y, float z)
{
    return (fm_clip_corner){ x * 2.0f / WIDTH - 1.0f, y * 2.0f / HEIGHT - 1.0f, z, 1.0f };
}

static uint32_t sum(const drawn *d)
{
    uint32_t count = 0;
    for (int i = 0; i < PIXEL_COUNT; i++)
        count += d->hits[i];
    return count;
}

/* The hypotenuse runs through centres: it is a left edge of the lower half and no left or top edge
 * of the upper one. */
static void centres_on_an_edge_belong_to_the_left_and_the_top(void **state)
{
    (void)state;
    drawn lower = { 0 }, upper = { 0 };
    rasterise(&lower, (fm_clip_corner[3]){ at(0, 0, 0.5f), at(4, 4, 0.5f), at(0, 4, 0.5f) });
    rasterise(&upper, (fm_clip_corner[3]){ at(0, 0, 0.5f), at(4, 0, 0.5f), at(4, 4, 0.5f) });
    assert_int_equal(sum(&lower), 6);
    assert_int_equal(sum(&upper), 10);
    assert_int_equal(upper.hits[0], 1);
    assert_int_equal(lower.hits[0], 0);
    assert_true(upper.depth[0] >= 0.5f && upper.depth[0] <= 0.5f);
}

static void both_orientations_are_drawn_alike(void **state)
{
    (void)state;
    drawn one = { 0 }, other = { 0 };
    rasterise(&one,
              (fm_clip_corner[3]){ at(1.3f, 0.2f, 0), at(14.1f, 3.7f, 1), at(2.9f, 7.5f, 0.3f) });
    rasterise(&other,
              (fm_clip_corner[3]){ at(1.3f, 0.2f, 0), at(2.9f, 7.5f, 0.3f), at(14.1f, 3.7f, 1) });
    assert_true(sum(&one) > 0);
    assert_memory_equal(one.hits, other.hits, sizeof one.hits);
}

static float uniform(uint64_t *random, float low, float high)
{
    return low + (high - low) * (float)(random_next(random) >> 40) * 0x1p-24f;
}

/* A fan around a point fills its polygon: no pixel twice, none left out of a viewport it covers. */
static void a_fan_covers_each_pixel_once(void **state)
{
    (void)state;
    uint64_t random = 7;
    for (int turn = 0; turn < 200; turn++) {
        drawn d = { 0 };
        const float far = turn % 2 == 0 ? 40.0f : 4e6f; /* the second is beyond the guard band */
        const fm_clip_corner ring[4] = { at(-far, -far, 0), at(far, -far, 1), at(far, far, 0),
                                         at(-far, far, 1) };
        const fm_clip_corner middle =
            at(uniform(&random, -3, WIDTH + 3), uniform(&random, -3, HEIGHT + 3), 0.5f);
        for (int i = 0; i < 4; i++)
            rasterise(&d, (fm_clip_corner[3]){ middle, ring[i], ring[(i + 1) % 4] });
        for (int i = 0; i < PIXEL_COUNT; i++)
            assert_int_equal(d.hits[i], 1);
    }
}

/* The near plane cuts the slanted quad where its depth is 0: what is behind the eye is not seen. */
static void what_is_before_the_near_plane_is_cut_off(void **state)
{
    (void)state;
    drawn d = { 0 };
    rasterise(&d, (fm_clip_corner[3]){ { -1, -1, -1, 1 }, { 1, -1, 1, 1 }, { -1, 1, -1, 1 } });
    rasterise(&d, (fm_clip_corner[3]){ { 1, -1, 1, 1 }, { 1, 1, 1, 1 }, { -1, 1, -1, 1 } });
    for (int i = 0; i < PIXEL_COUNT; i++)
        assert_int_equal(d.hits[i], i % WIDTH >= WIDTH / 2);
    drawn behind = { 0 };
    rasterise(&behind, (fm_clip_corner[3]){ { -1, -1, 0, -1 }, { 1, -1, 0, -1 }, { 0, 1, 0, -2 } });
    rasterise(&behind, (fm_clip_corner[3]){ { -1, -1, 2, 1 }, { 1, -1, 2, 1 }, { 0, 1, 3, 1 } });
    assert_int_equal(sum(&behind), 0);
}

/* A floor that reaches behind the eye: all below the horizon, which lies at the middle. */
static void a_triangle_through_the_eyes_plane_is_cut(void **state)
{
    (void)state;
    drawn d = { 0 };
    rasterise(&d, (fm_clip_corner[3]){
                      { -1e5f, 1, 0.1f, -50 }, { 1e5f, 1, 0.1f, -50 }, { 0, 1, 0.1f, 1e5f } });
    for (int i = 0; i < PIXEL_COUNT; i++)
        assert_int_equal(d.hits[i], i / WIDTH >= HEIGHT / 2);
}

static void triangles_without_area_or_numbers_cover_nothing(void **state)
{
    (void)state;
    drawn d = { 0 };
    rasterise(&d, (fm_clip_corner[3]){ at(1, 1, 0), at(1, 1, 0), at(9, 5, 0) });
    rasterise(&d, (fm_clip_corner[3]){ at(1, 1, 0), at(5, 3, 0), at(9, 5, 0) });
    rasterise(&d, (fm_clip_corner[3]){ at(1, 1, NAN), at(5, 1, 0), at(9, 5, 0) });
    rasterise(&d, (fm_clip_corner[3]){ at(1, 1, 0), { INFINITY, 0, 0, 1 }, at(9, 5, 0) });
    rasterise(&d, (fm_clip_corner[3]){ { 0, 0, 0, 0 }, { 0, 0, 0, 0 }, { 0, 0, 0, 0 } });
    rasterise(&d,
              (fm_clip_corner[3]){ at(2.51f, 2.51f, 0), at(2.6f, 2.51f, 0), at(2.51f, 2.6f, 0) });
    assert_int_equal(sum(&d), 0);
}

static void depth_follows_the_plane_and_ends_at_the_corners(void **state)
{
    (void)state;
    drawn d = { 0 };
    rasterise(&d, (fm_clip_corner[3]){ at(0, 0, 0.0f), at(32, 0, 1.0f), at(0, 16, 0.0f) });
    for (uint32_t x = 0; x < WIDTH; x++)
        assert_true(fabsf(d.depth[x] - ((float)x + 0.5f) / 32.0f) < 1e-6f);
    drawn tiny = { 0 };
    rasterise(&tiny, (fm_clip_corner[3]){ at(0, 0, 1e-39f), at(32, 0, 1e-39f), at(0, 16, 1e-39f) });
    assert_true(tiny.hits[0] == 1 && tiny.depth[0] <= 0.0f);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(centres_on_an_edge_belong_to_the_left_and_the_top),
        cmocka_unit_test(both_orientations_are_drawn_alike),
        cmocka_unit_test(a_fan_covers_each_pixel_once),
        cmocka_unit_test(what_is_before_the_near_plane_is_cut_off),
        cmocka_unit_test(a_triangle_through_the_eyes_plane_is_cut),
        cmocka_unit_test(triangles_without_area_or_numbers_cover_nothing),
        cmocka_unit_test(depth_follows_the_plane_and_ends_at_the_corners),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
