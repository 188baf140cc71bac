/* Polygons cut into triangles: what is covered, and what is refused. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <time.h>

#include "mesh/orient.h"
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

/* A border that goes along cracks, there and back, and touches itself at their ends. */
static void cracks_lose_no_area(void **state)
{
    (void)state;
    const vec3 cracked[] = { { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 1, 2, 0 }, { 1, 1, 0 },
                             { 2, 1, 0 }, { 1, 1, 0 }, { 1, 0, 0 }, { 3, 0, 0 }, { 3, 1, 0 },
                             { 2, 1, 0 }, { 3, 1, 0 }, { 3, 3, 0 }, { 0, 3, 0 } };
    assert_covers(cracked, COUNT(cracked), 0, 9.0);
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

/* Differences and products of these coordinates round. */
static void sides_of_lines_are_exact(void **state)
{
    const double a[2] = { 0x1p-400, 0 }, b[2] = { 1 + DBL_EPSILON, 1 }, c[2] = { 1, 1 };
    const double p[2] = { 0x1p-53, 0x1p-53 }, q[2] = { 12, 12 }, r[2] = { 24, 24 };
    const double beside[2] = { 24, 24 + 0x1p-48 };
    (void)state;
    assert_true(orient(a, b, c) > 0.0 && orient(b, a, c) < 0.0);
    assert_true(orient(a, c, b) < 0.0 && orient(c, b, a) < 0.0);
    assert_true(orient(a, c, (double[2]){ 1 - 0x1p-53, 1 }) > 0.0);
    assert_true(orient(p, q, r) >= 0.0 && orient(p, q, r) <= 0.0);
    assert_true(orient(p, q, beside) > 0.0 && orient(beside, q, p) < 0.0);
}

/* A power of two does not take corners off the line that they lie on. */
static void straight_corners_stay_straight(void **state)
{
    (void)state;
    const vec3 nine[] = { { 1, 0, 0 }, { 3, 0, 0 }, { 4, 1, 0 }, { 4, 2, 0 }, { 3, 5, 0 },
                          { 2, 5, 0 }, { 3, 2, 0 }, { 2, 1, 0 }, { 0, 3, 0 } };
    assert_covers(nine, COUNT(nine), 0, 8.5);
}

enum { RANDOM_MAX = 16 };

static int side(const int a[2], const int b[2], const int c[2])
{
    const int twice = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    return (twice > 0) - (twice < 0);
}

static bool lies_on(const int a[2], const int b[2], const int p[2])
{
    for (int axis = 0; axis < 2; axis++)
        if ((p[axis] < a[axis] && p[axis] < b[axis]) || (p[axis] > a[axis] && p[axis] > b[axis]))
            return false;
    return side(a, b, p) == 0;
}

/* Edges i and j share a point that is no common corner, or fold onto each other. */
static bool edges_meet(int p[][2], int count, int i, int j)
{
    const int *a = p[i], *b = p[(i + 1) % count], *c = p[j], *d = p[(j + 1) % count];
    if (j == i + 1)
        return lies_on(a, b, d) || lies_on(c, d, a);
    if ((j + 1) % count == i)
        return lies_on(a, b, c) || lies_on(c, d, b);
    return (side(a, b, c) * side(a, b, d) < 0 && side(c, d, a) * side(c, d, b) < 0) ||
           lies_on(a, b, c) || lies_on(a, b, d) || lies_on(c, d, a) || lies_on(c, d, b);
}

/* Turns about the corners between two edges that meet. */
static bool untangle_once(int p[][2], int count)
{
    for (int i = 0; i < count; i++)
        for (int j = i + 1; j < count; j++) {
            if (!edges_meet(p, count, i, j))
                continue;
            for (int low = i + 1, high = j; low < high; low++, high--)
                for (int axis = 0; axis < 2; axis++) {
                    const int held = p[low][axis];
                    p[low][axis] = p[high][axis];
                    p[high][axis] = held;
                }
            return true;
        }
    return false;
}

static int below(uint32_t *seed, uint32_t bound)
{
    *seed = *seed * 1664525u + 1013904223u;
    return (int)((*seed >> 8) % bound);
}

/* Twice the area of a simple polygon with corners on a small grid; 0: none was found. */
static int random_polygon(int p[][2], int count, uint32_t *seed)
{
    const uint32_t grid = 3 + (uint32_t)below(seed, 7);
    int tries = 200, area = 0;
    for (int i = 0; i < count; i++)
        for (int axis = 0; axis < 2; axis++)
            p[i][axis] = below(seed, grid);
    while (tries > 0 && untangle_once(p, count))
        tries--;
    for (int i = 0; i < count && tries > 0; i++)
        area += p[i][0] * p[(i + 1) % count][1] - p[(i + 1) % count][0] * p[i][1];
    return area;
}

/* Turned in space, so that what is straight is so only but for rounding. */
static void simple_polygons_are_never_refused(void **state)
{
    enum { TRIES = 40000 };
    uint32_t seed = 3;
    int p[RANDOM_MAX][2], made = 0;
    vec3 corners[RANDOM_MAX];
    (void)state;
    for (int i = 0; i < TRIES; i++) {
        const int count = 4 + below(&seed, RANDOM_MAX - 3);
        const double angle = 0.7 * below(&seed, 4), c = cos(angle), s = sin(angle);
        const int area = random_polygon(p, count, &seed);
        if (area == 0)
            continue;
        for (int j = 0; j < count; j++)
            corners[j] = (vec3){ p[j][0] * c + 5, p[j][1], p[j][0] * s - 3 };
        const double up = area > 0 ? 1.0 : -1.0;
        fm_triangulator t = { 0 };
        assert_int_equal(cut(&t, corners, (size_t)count), FM_CUT);
        const double covered = area_of(&t, corners, (vec3){ -s * up, 0, c * up });
        assert_true(fabs(covered - 0.5 * abs(area)) < rounding * abs(area));
        triangulator_free(&t);
        made++;
    }
    assert_true(made > TRIES / 4);
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

/* Zigzags have few ears at a time. The time of a try for each pair of corners is legal, that of
 * each three is a minute. */
static void time_grows_with_the_square_at_most(void **state)
{
    enum { ZIGZAG = 4096, BACK = 120000 };
    static vec3 corners[BACK];
    const clock_t start = clock();
    (void)state;
    for (int i = 0; i < ZIGZAG / 2; i++) {
        corners[i] = (vec3){ i, i % 2 != 0 ? 10 : 1, 0 };
        corners[ZIGZAG - 1 - i] = (vec3){ i, i % 2 != 0 ? 9.5 : 0.5, 0 };
    }
    assert_cut(corners, ZIGZAG, FM_CUT);
    for (int i = 0; i < BACK / 2; i++)
        corners[i] = corners[(BACK - i) % BACK] = (vec3){ i, (double)i * i, 0 };
    corners[BACK / 2] = (vec3){ BACK, 1, 0 };
    assert_cut(corners, BACK, FM_CUT_NO_AREA);
    assert_true((double)(clock() - start) < 10.0 * CLOCKS_PER_SEC);
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
        cmocka_unit_test(cracks_lose_no_area),
        cmocka_unit_test(corners_on_edges_lose_no_area),
        cmocka_unit_test(sides_of_lines_are_exact),
        cmocka_unit_test(straight_corners_stay_straight),
        cmocka_unit_test(simple_polygons_are_never_refused),
        cmocka_unit_test(size_and_place_do_not_matter),
        cmocka_unit_test(what_has_no_area_has_no_triangles),
        cmocka_unit_test(borders_that_cross_are_refused),
        cmocka_unit_test(warped_quads_are_cut_from_the_first_corner),
        cmocka_unit_test(time_grows_with_the_square_at_most),
        cmocka_unit_test(only_large_concave_polygons_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
