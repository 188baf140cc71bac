#include "triangulate.h"

#include <float.h>
#include <stdlib.h>

#include "orient.h"
#include "weld.h"

/* Of products of two lengths that were rounded a few times. */
static const double rounding = 4 * DBL_EPSILON;
/* How far corners of a flat polygon may lie off its plane, of the power of two above its size: what
 * files round. */
static const double planar_max = 1e-3;
/* Seen coordinates below this are 0: so small a part of the polygon's size is no shape. */
static const double seen_min = 0x1p-400;

bool triangulator_reserve(fm_triangulator *t, size_t count)
{
    if (count <= t->room)
        return true;
    count = count < 2 * t->room ? 2 * t->room : count;
    triangulator_free(t);
    t->corners = calloc(count, sizeof *t->corners);
    t->triangles = calloc(count, 3 * sizeof *t->triangles);
    t->flat = calloc(count, sizeof *t->flat);
    t->previous = calloc(count, sizeof *t->previous);
    t->next = calloc(count, sizeof *t->next);
    t->is_reflex = calloc(count, sizeof *t->is_reflex);
    t->ear_kinds = calloc(count, sizeof *t->ear_kinds);
    t->room = count;
    return t->corners != NULL && t->triangles != NULL && t->flat != NULL && t->previous != NULL &&
           t->next != NULL && t->is_reflex != NULL && t->ear_kinds != NULL;
}

void triangulator_free(fm_triangulator *t)
{
    free(t->corners);
    free(t->triangles);
    free(t->flat);
    free(t->previous);
    free(t->next);
    free(t->is_reflex);
    free(t->ear_kinds);
    *t = (fm_triangulator){ 0 };
}

static double largest(vec3 v)
{
    return fmax(fabs(v.x), fmax(fabs(v.y), fabs(v.z)));
}

static vec3 scaled(vec3 v, double factor)
{
    return (vec3){ v.x * factor, v.y * factor, v.z * factor };
}

/* Halves keep differences within a double. */
static vec3 half_edge(vec3 from, vec3 to)
{
    return minus(scaled(to, 0.5), scaled(from, 0.5));
}

bool triangle_has_area(vec3 a, vec3 b, vec3 c)
{
    vec3 ab = half_edge(a, b), ac = half_edge(a, c);
    const double ab_size = largest(ab), ac_size = largest(ac);
    if (!(ab_size > 0.0 && ac_size > 0.0))
        return false;
    ab = (vec3){ ab.x / ab_size, ab.y / ab_size, ab.z / ab_size };
    ac = (vec3){ ac.x / ac_size, ac.y / ac_size, ac.z / ac_size };
    return largest(cross(ab, ac)) > rounding;
}

/* Corners relative to the first one, the farthest at 1/2 to 1; false: all are one point. A power of
 * two keeps on a line what is on a line. */
static bool normalise(fm_triangulator *t, size_t count)
{
    const vec3 first = t->corners[0];
    double size = 0.0;
    int exponent;
    for (size_t i = 0; i < count; i++) {
        t->corners[i] = half_edge(first, t->corners[i]);
        size = fmax(size, largest(t->corners[i]));
    }
    frexp(size, &exponent);
    for (size_t i = 0; i < count; i++) {
        const vec3 p = t->corners[i];
        t->corners[i] = (vec3){ ldexp(p.x, -exponent) + 0.0, ldexp(p.y, -exponent) + 0.0,
                                ldexp(p.z, -exponent) + 0.0 }; /* -0 and 0 are one place */
    }
    return size > 0.0;
}

/* Newell's normal: twice the areas of the polygon's shadows. *spread: what was added up. */
static vec3 area_normal(double *spread, const fm_triangulator *t, size_t count)
{
    vec3 sum = { 0 };
    *spread = 0.0;
    for (size_t i = 1; i + 1 < count; i++) {
        const vec3 part = cross(t->corners[i], t->corners[i + 1]);
        sum = plus(sum, part);
        *spread += largest(part);
    }
    return sum;
}

/* Seen along the axis nearest to the normal, so that the polygon turns to the left. */
static void flatten(fm_triangulator *t, size_t count, vec3 normal)
{
    const double n[3] = { normal.x, normal.y, normal.z };
    int axis = fabs(n[0]) > fabs(n[1]) ? 0 : 1;
    axis = fabs(n[2]) > fabs(n[axis]) ? 2 : axis;
    const int u = (axis + (n[axis] > 0.0 ? 1 : 2)) % 3, v = (axis + (n[axis] > 0.0 ? 2 : 1)) % 3;
    for (size_t i = 0; i < count; i++) {
        const double p[3] = { t->corners[i].x, t->corners[i].y, t->corners[i].z };
        t->flat[i][0] = fabs(p[u]) < seen_min ? 0.0 : p[u];
        t->flat[i][1] = fabs(p[v]) < seen_min ? 0.0 : p[v];
    }
}

/* Above 0: c lies to the left of the line from a to b. */
static double turn(const fm_triangulator *t, uint32_t a, uint32_t b, uint32_t c)
{
    return orient(t->flat[a], t->flat[b], t->flat[c]);
}

static void emit(fm_triangulator *t, uint32_t a, uint32_t b, uint32_t c)
{
    if (!triangle_has_area(t->corners[a], t->corners[b], t->corners[c]))
        return;
    uint32_t *triangle = t->triangles + 3 * t->triangle_count++;
    triangle[0] = a;
    triangle[1] = b;
    triangle[2] = c;
}

/* All corners turn left, and all lie about the first one in order: so the border turns once. */
static bool is_convex(const fm_triangulator *t, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++)
        if (turn(t, i, (i + 1) % count, (i + 2) % count) < 0.0)
            return false;
    for (uint32_t i = 1; i + 1 < count; i++)
        if (turn(t, 0, i, i + 1) < 0.0)
            return false;
    return true;
}

static bool is_same_place(const fm_triangulator *t, uint32_t a, uint32_t b)
{
    return t->flat[a][0] >= t->flat[b][0] && t->flat[a][0] <= t->flat[b][0] &&
           t->flat[a][1] >= t->flat[b][1] && t->flat[a][1] <= t->flat[b][1];
}

/* Where a point lies of a triangle that turns left. */
typedef enum place { OUTSIDE, ON_BORDER, WITHIN } place;

static place place_of(const fm_triangulator *t, uint32_t p, const uint32_t ear[3])
{
    place found = WITHIN;
    for (int i = 0; i < 3; i++) {
        if (is_same_place(t, p, ear[i]))
            return OUTSIDE;
        const double side = turn(t, ear[i], ear[(i + 1) % 3], p);
        if (side < 0.0)
            return OUTSIDE;
        found = side <= 0.0 ? ON_BORDER : found;
    }
    return found;
}

/* The border goes out to the tip and straight back, or stands still: nothing lies within. */
static bool is_spike(const fm_triangulator *t, const uint32_t ear[3])
{
    double dot = 0.0;
    for (int axis = 0; axis < 2; axis++)
        dot += (t->flat[ear[1]][axis] - t->flat[ear[0]][axis]) *
               (t->flat[ear[2]][axis] - t->flat[ear[1]][axis]);
    return dot <= 0.0;
}

/* What may be cut off, the surest first. */
enum ear_kind {
    EAR_SPIKE, /* without area */
    EAR_CLEAR, /* no other corner touches it */
    EAR_ANY,   /* others may lie on its border */
    EAR_NONE
};

/* Only reflex corners can lie within an ear. */
static uint8_t ear_kind_of(const fm_triangulator *t, uint32_t tip)
{
    const uint32_t ear[3] = { t->previous[tip], tip, t->next[tip] };
    const double side = turn(t, ear[0], ear[1], ear[2]);
    if (side < 0.0)
        return EAR_NONE;
    if (side <= 0.0)
        return is_spike(t, ear) ? EAR_SPIKE : EAR_ANY;
    uint8_t kind = EAR_CLEAR;
    for (uint32_t p = t->next[ear[2]]; p != ear[0]; p = t->next[p]) {
        const place at = t->is_reflex[p] ? place_of(t, p, ear) : OUTSIDE;
        if (at == WITHIN)
            return EAR_NONE;
        kind = at == ON_BORDER ? EAR_ANY : kind;
    }
    return kind;
}

static void set_reflex(fm_triangulator *t, uint32_t i)
{
    t->is_reflex[i] = turn(t, t->previous[i], i, t->next[i]) <= 0.0;
}

/* The next ear from `from` on, among the corners that are left, by what is known of them. */
static bool find_ear(uint32_t *ear, const fm_triangulator *t, uint32_t from, uint32_t left)
{
    for (uint8_t kind = EAR_SPIKE; kind < EAR_NONE; kind++) {
        *ear = from;
        for (uint32_t i = 0; i < left; i++, *ear = t->next[*ear])
            if (t->ear_kinds[*ear] == kind)
                return true;
    }
    return false;
}

static void find_kinds(fm_triangulator *t, uint32_t from, uint32_t left)
{
    for (uint32_t i = 0, at = from; i < left; i++, at = t->next[at])
        t->ear_kinds[at] = ear_kind_of(t, at);
}

/* A cut changes what its two neighbours are. What it changes of others, where borders touch, is
 * found when they are about to be cut, or when nothing else is left. */
static bool next_ear(uint32_t *ear, fm_triangulator *t, uint32_t from, uint32_t left)
{
    while (find_ear(ear, t, from, left)) {
        const uint8_t known = t->ear_kinds[*ear];
        t->ear_kinds[*ear] = ear_kind_of(t, *ear);
        if (t->ear_kinds[*ear] <= known)
            return true;
    }
    find_kinds(t, from, left);
    return find_ear(ear, t, from, left);
}

static void begin_ears(fm_triangulator *t, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++) {
        t->previous[i] = (i + count - 1) % count;
        t->next[i] = (i + 1) % count;
    }
    for (uint32_t i = 0; i < count; i++)
        set_reflex(t, i);
    find_kinds(t, 0, count);
}

static void cut_off(fm_triangulator *t, uint32_t tip)
{
    const uint32_t before = t->previous[tip], after = t->next[tip];
    emit(t, before, tip, after);
    t->next[before] = after;
    t->previous[after] = before;
    set_reflex(t, before);
    set_reflex(t, after);
    t->ear_kinds[before] = ear_kind_of(t, before);
    t->ear_kinds[after] = ear_kind_of(t, after);
}

static fm_cut cut_ears(fm_triangulator *t, uint32_t count)
{
    uint32_t at = 0;
    begin_ears(t, count);
    for (uint32_t left = count; left > 3; left--) {
        if (!next_ear(&at, t, at, left))
            return FM_CUT_CROSSES;
        cut_off(t, at);
        at = t->next[at];
    }
    if (turn(t, t->previous[at], at, t->next[at]) < 0.0)
        return FM_CUT_CROSSES;
    emit(t, t->previous[at], at, t->next[at]);
    return FM_CUT;
}

static void cut_fan(fm_triangulator *t, uint32_t count)
{
    t->triangle_count = 0;
    for (uint32_t i = 1; i + 1 < count; i++)
        emit(t, 0, i, i + 1);
}

static fm_cut cut_flat(fm_triangulator *t, uint32_t count)
{
    if (is_convex(t, count)) {
        cut_fan(t, count);
        return FM_CUT;
    }
    return count > POLYGON_CONCAVE_MAX ? FM_CUT_TOO_LARGE : cut_ears(t, count);
}

static bool is_one_line(const fm_triangulator *t, size_t count)
{
    for (size_t i = 1; i + 1 < count; i++)
        if (triangle_has_area(t->corners[0], t->corners[i], t->corners[i + 1]))
            return false;
    return true;
}

/* An edge by the numbers of its places. */
typedef uint32_t edge[2];

/* edges: [count] of the border, then [count] the same ones backwards. */
static void fill_edges(edge *edges, const uint32_t *places, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        edges[i][0] = edges[count + i][1] = places[i];
        edges[i][1] = edges[count + i][0] = places[(i + 1) % count];
    }
}

/* Whether each edge is gone both ways, there and back: then there is no area. */
static fm_cut cut_without_area(const fm_triangulator *t, size_t count)
{
    fm_cut cut = FM_CUT_NO_MEMORY;
    uint32_t *firsts = calloc(count, 2 * sizeof *firsts);
    edge *edges = calloc(count, 2 * sizeof *edges);
    if (firsts != NULL && edges != NULL && weld(firsts, t->corners, sizeof t->corners[0], count)) {
        fill_edges(edges, firsts, count);
        if (weld(firsts, edges, sizeof edges[0], 2 * count)) {
            cut = FM_CUT_NO_AREA;
            for (size_t i = count; i < 2 * count; i++)
                cut = firsts[i] < count ? cut : FM_CUT_CROSSES;
        }
    }
    free(firsts);
    free(edges);
    return cut;
}

/* Whether all corners lie in the plane of the largest triangle at the first one. */
static bool is_planar(const fm_triangulator *t, size_t count)
{
    vec3 normal = { 0 };
    for (size_t i = 1; i + 1 < count; i++) {
        const vec3 part = cross(t->corners[i], t->corners[i + 1]);
        normal = dot(part, part) > dot(normal, normal) ? part : normal;
    }
    normal = normalized(normal);
    for (size_t i = 1; i < count; i++)
        if (fabs(dot(normal, t->corners[i])) > planar_max)
            return false;
    return true;
}

/* Cuts what is seen along the mean normal. */
static fm_cut cut_seen(fm_triangulator *t, size_t count)
{
    double spread;
    const vec3 normal = area_normal(&spread, t, count);
    if (!(largest(normal) > rounding * spread))
        return cut_without_area(t, count);
    flatten(t, count, normal);
    return cut_flat(t, (uint32_t)count);
}

fm_cut polygon_cut(fm_triangulator *t, size_t count)
{
    t->triangle_count = 0;
    if (count == 3) {
        emit(t, 0, 1, 2);
        return t->triangle_count > 0 ? FM_CUT : FM_CUT_NO_AREA;
    }
    if (!normalise(t, count) || is_one_line(t, count))
        return FM_CUT_NO_AREA;
    fm_cut cut = cut_seen(t, count);
    if (cut == FM_CUT_CROSSES && !is_planar(t, count)) {
        cut_fan(t, (uint32_t)count);
        cut = FM_CUT_WARPED;
    }
    return cut == FM_CUT && t->triangle_count == 0 ? FM_CUT_NO_AREA : cut;
}
