/* Polygons cut into triangles: what is covered, and what is refused. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>

#include "mesh/triangulate.h"

static const double rounding = 1e-12;

/* Of all triangles; each must turn as `up` says. */
static double area_of(const fm_triangulator *t, const vec3 *corners, vec3 up)
{
    double sum = 0.0;
    for (size_t i = 0; i < t->triangle_count; i++) {
        const uint32_t *c = &t->triangles[3 * i];
        const vec3 n =
            cross(minus(corners[c[1]], corners[c[0]]), minus(corners[c[2]], corners[c[0]]));
        assert_true(dot(n, up) > 0.0);
        sum += 0.5 * dot(n, up);
    }
    return sum;
}

static fm_cut cut(fm_triangulator *t, const vec3 *corners, size_t count)
{
    assert_true(triangulator_reserve(t, count));
    for (size_t i = 0; i < count; i++)
        t->corners[i] = corners[i];
    return polygon_cut(t, count);
}

static void assert_covers(const vec3 *corners, size_t count, size_t triangles, double area)
{
    fm_triangulator t = { 0 };
    assert_int_equal(cut(&t, corners, count), FM_CUT);
    if (triangles > 0)
        assert_int_equal(t.triangle_count, triangles);
    assert_true(fabs(area_of(&t, corners, (vec3){ 0, 0, 1 }) - area) < rounding * fmax(area, 1.0));
    triangulator_free(&t);
}

static void assert_cut(const vec3 *corners, size_t count, fm_cut expected)
{
    fm_triangulator t = { 0 };
    assert_int_equal(cut(&t, corners, count), expected);
    triangulator_free(&t);
}

#define COUNT(array) (sizeof(array) / sizeof(array)[0])

static void convex_polygons_are_fans(void **state)
{
    vec3 circle[12];
    (void)state;
    for (int i = 0; i < 12; i++)
        circle[i] = (vec3){ cos(i * 0.52359877559829887), sin(i * 0.52359877559829887), 0 };
    assert_covers(circle, 12, 10, 3.0);
    const vec3 square[] = { { 0, 0, 0 }, { 2, 0, 0 }, { 2, 2, 0 }, { 0, 2, 0 } };
    assert_covers(square, COUNT(square), 2, 4.0);
}

/* A fan from corner 0 would cover what lies outside. */
static void concave_polygons_keep_their_notch(void **state)
{
    (void)state;
    const vec3 notch[] = { { 0, 0, 0 }, { 4, 0, 0 }, { 4, 4, 0 }, { 2, 1, 0 }, { 0, 4, 0 } };
    assert_covers(notch, COUNT(notch), 3, 10.0);
    const vec3 dart[] = { { 0, 0, 0 }, { 2, 1, 0 }, { 0, 2, 0 }, { 1, 1, 0 } };
    assert_covers(dart, COUNT(dart), 2, 1.0);
}

/* Every second corner of a comb is reflex, at any start. */
static void combs_are_covered_whatever_the_first_corner(void **state)
{
    enum { TEETH = 9, CORNERS = 2 * TEETH + 3 };
    vec3 comb[CORNERS], turned[CORNERS];
    (void)state;
    for (int i = 0; i <= 2 * TEETH; i++)
        comb[i] = (vec3){ 2 * TEETH - i, i % 2 == 0 ? 1 : 3, 0 };
    comb[CORNERS - 2] = (vec3){ 0, 0, 0 };
    comb[CORNERS - 1] = (vec3){ 2 * TEETH, 0, 0 };
    for (int start = 0; start < CORNERS; start++) {
        for (int i = 0; i < CORNERS; i++)
            turned[i] = comb[(i + start) % CORNERS];
        assert_covers(turned, CORNERS, CORNERS - 2, 2 * TEETH + 2 * TEETH);
    }
}

/* A hole that a border reaches by a bridge, which it goes twice. */
static void holes_on_bridges_stay_open(void **state)
{
    (void)state;
    const vec3 ring[] = { { 0, 0, 0 }, { 4, 0, 0 }, { 4, 4, 0 }, { 0, 4, 0 }, { 0, 0, 0 },
                          { 1, 1, 0 }, { 1, 3, 0 }, { 3, 3, 0 }, { 3, 1, 0 }, { 1, 1, 0 } };
    assert_covers(ring, COUNT(ring), 0, 12.0);
}

static void corners_on_edges_lose_no_area(void **state)
{
    (void)state;
    const vec3 edge[] = { { 0, 0, 0 }, { 1, 0, 0 }, { 2, 0, 0 }, { 2, 2, 0 }, { 0, 2, 0 } };
    assert_covers(edge, COUNT(edge), 0, 4.0);
    const vec3 spike[] = { { 0, 0, 0 }, { 2, 0, 0 }, { 3, 0, 0 },
                           { 2, 0, 0 }, { 2, 2, 0 }, { 0, 2, 0 } };
    assert_covers(spike, COUNT(spike), 0, 4.0);
    const vec3 twice[] = { { 0, 0, 0 }, { 2, 0, 0 }, { 2, 0, 0 }, { 2, 2, 0 }, { 0, 2, 0 } };
    assert_covers(twice, COUNT(twice), 0, 4.0);
}

static void size_and_place_do_not_matter(void **state)
{
    static const double sizes[] = { 1e-300, 1e-8, 1.0, 1e30, 1e300 };
    fm_triangulator t = { 0 };
    (void)state;
    for (size_t i = 0; i < COUNT(sizes); i++) {
        const double s = sizes[i];
        const vec3 notch[] = {
            { 0, 0, 0 }, { 4 * s, 0, 0 }, { 4 * s, 4 * s, 0 }, { 2 * s, s, 0 }, { 0, 4 * s, 0 }
        };
        assert_int_equal(cut(&t, notch, COUNT(notch)), FM_CUT);
        assert_int_equal(t.triangle_count, 3);
        assert_int_equal(cut(&t, notch, 3), FM_CUT);
        assert_int_equal(t.triangle_count, 1);
    }
    triangulator_free(&t);
}

static void what_has_no_area_has_no_triangles(void **state)
{
    (void)state;
    const vec3 line[] = { { 0, 0, 0 }, { 0.1, 0.2, 0.3 }, { 0.2, 0.4, 0.6 }, { 0.7, 1.4, 2.1 } };
    assert_cut(line, 3, FM_CUT_NO_AREA);
    assert_cut(line, 4, FM_CUT_NO_AREA);
    const vec3 point[] = { { 1, 2, 3 }, { 1, 2, 3 }, { 1, 2, 3 }, { 1, 2, 3 } };
    assert_cut(point, 3, FM_CUT_NO_AREA);
    assert_cut(point, 4, FM_CUT_NO_AREA);
    const vec3 back[] = { { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 1, 0, 0 } };
    assert_cut(back, 4, FM_CUT_NO_AREA);
}

static void borders_that_cross_are_refused(void **state)
{
    (void)state;
    const vec3 bow[] = { { 0, 0, 0 }, { 1, 1, 0 }, { 1, 0, 0 }, { 0, 1, 0 } };
    assert_cut(bow, COUNT(bow), FM_CUT_CROSSES);
    const vec3 uneven[] = { { 0, 0, 0 }, { 4, 4, 0 }, { 4, 0, 0 }, { 0, 1, 0 } };
    assert_cut(uneven, COUNT(uneven), FM_CUT_CROSSES);
}

/* A quad of a rough height field: no plane shows it as one piece, and both cuts are a surface. */
static void warped_quads_are_cut_from_the_first_corner(void **state)
{
    (void)state;
    const vec3 rough[] = { { 0, 0, 0 }, { 0.01, 0, 1 }, { 0.01, 0.01, 0.2 }, { 0, 0.01, 1 } };
    fm_triangulator t = { 0 };
    assert_int_equal(cut(&t, rough, COUNT(rough)), FM_CUT_WARPED);
    assert_int_equal(t.triangle_count, 2);
    assert_int_equal(t.triangles[0], 0);
    assert_int_equal(t.triangles[3], 0);
    triangulator_free(&t);
    const vec3 mild[] = { { 0, 0, 0 }, { 1, 0, 0.1 }, { 1, 1, 0 }, { 0, 1, 0.1 } };
    assert_cut(mild, COUNT(mild), FM_CUT);
}

/* Convex ones have no limit. */
static void only_large_concave_polygons_are_refused(void **state)
{
    enum { CORNERS = POLYGON_CONCAVE_MAX + 1 };
    static vec3 round[CORNERS];
    (void)state;
    for (int i = 0; i < CORNERS; i++)
        round[i] = (vec3){ i, (double)i * i, 0 };
    assert_cut(round, CORNERS, FM_CUT);
    round[CORNERS / 2].y += 1e6;
    assert_cut(round, CORNERS, FM_CUT_TOO_LARGE);
    assert_cut(round, CORNERS - 1, FM_CUT);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(convex_polygons_are_fans),
        cmocka_unit_test(concave_polygons_keep_their_notch),
        cmocka_unit_test(combs_are_covered_whatever_the_first_corner),
        cmocka_unit_test(holes_on_bridges_stay_open),
        cmocka_unit_test(corners_on_edges_lose_no_area),
        cmocka_unit_test(size_and_place_do_not_matter),
        cmocka_unit_test(what_has_no_area_has_no_triangles),
        cmocka_unit_test(borders_that_cross_are_refused),
        cmocka_unit_test(warped_quads_are_cut_from_the_first_corner),
        cmocka_unit_test(only_large_concave_polygons_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
