#include "builder.h"

#include <assert.h>
#include <math.h>

#include "base/random.h"
#include "scene/shade.h"
#include "turns.h"

void builder_begin(fm_builder *b, const fm_settings *settings, const fm_mesh_sink *sink,
                   fm_error *err)
{
    b->settings = settings;
    b->sink = sink;
    b->err = err;
    b->status = FM_OK;
    b->random = settings->seed;
    b->pose = FM_POSE_UNIT;
    b->colour = FM_STONE;
    b->vertex_count = b->index_count = b->parts = 0;
    b->vertices_held = b->indices_held = 0;
    b->box = (fm_box){ { INFINITY, INFINITY, INFINITY }, { -INFINITY, -INFINITY, -INFINITY } };
}

static void flush_vertices(fm_builder *b)
{
    if (b->sink != NULL && b->status == FM_OK && b->vertices_held > 0)
        b->status = b->sink->vertices(b->sink->user, b->vertex_count - b->vertices_held,
                                      b->vertices, b->vertices_held, b->err);
    b->vertices_held = 0;
}

static void flush_indices(fm_builder *b)
{
    if (b->sink != NULL && b->status == FM_OK && b->indices_held > 0)
        b->status = b->sink->indices(b->sink->user, b->index_count - b->indices_held, b->indices,
                                     b->indices_held, b->err);
    b->indices_held = 0;
}

fm_status builder_end(fm_builder *b)
{
    flush_vertices(b);
    flush_indices(b);
    return b->status;
}

uint32_t builder_triangles(const fm_builder *b)
{
    return b->index_count / 3;
}

double builder_random(fm_builder *b)
{
    return (double)(random_next(&b->random) >> 11) * 0x1p-53;
}

double builder_between(fm_builder *b, double low, double high)
{
    return low + (high - low) * builder_random(b);
}

vec3 builder_within(fm_builder *b, vec3 low, vec3 high)
{
    vec3 v;
    v.x = builder_between(b, low.x, high.x);
    v.y = builder_between(b, low.y, high.y);
    v.z = builder_between(b, low.z, high.z);
    return v;
}

void build_part(fm_builder *b)
{
    b->parts++;
}

static vec3 turned(const fm_pose *pose, vec3 v)
{
    const vec3 x = { v.x * pose->x.x, v.x * pose->x.y, v.x * pose->x.z };
    return plus_scaled(plus_scaled(x, pose->y, v.y), pose->z, v.z);
}

static void widen(fm_box *box, vec3 p)
{
    const double position[3] = { p.x, p.y, p.z };
    for (int axis = 0; axis < 3; axis++) {
        box->low[axis] = fmin(box->low[axis], position[axis]);
        box->high[axis] = fmax(box->high[axis], position[axis]);
    }
}

uint32_t build_vertex(fm_builder *b, vec3 position, vec3 normal)
{
    const vec3 p = plus(turned(&b->pose, position), b->pose.origin);
    if (b->sink == NULL)
        widen(&b->box, p);
    else
        b->vertices[b->vertices_held++] =
            (fm_vertex){ { (float)p.x, (float)p.y, (float)p.z },
                         shade(turned(&b->pose, normal), b->colour, b->settings->alpha) };
    b->vertex_count++;
    if (b->vertices_held == BUILDER_BLOCK)
        flush_vertices(b);
    return b->vertex_count - 1;
}

void build_triangle(fm_builder *b, uint32_t i, uint32_t j, uint32_t k)
{
    const uint32_t corners[3] = { i, j, k };
    assert(i < b->vertex_count && j < b->vertex_count && k < b->vertex_count);
    b->index_count += 3;
    if (b->sink == NULL)
        return;
    if (b->indices_held + 3 > BUILDER_BLOCK) {
        b->index_count -= 3;
        flush_indices(b);
        b->index_count += 3;
    }
    for (int corner = 0; corner < 3; corner++)
        b->indices[b->indices_held++] = corners[corner];
}

void build_quad(fm_builder *b, vec3 p, vec3 q, vec3 r, vec3 s)
{
    const vec3 normal = cross(minus(r, p), minus(s, q));
    const uint32_t first = build_vertex(b, p, normal);
    build_vertex(b, q, normal);
    build_vertex(b, r, normal);
    build_vertex(b, s, normal);
    build_triangle(b, first, first + 1, first + 2);
    build_triangle(b, first, first + 2, first + 3);
}

/* Corner i of a box: bit 0 is x, bit 1 y, bit 2 z. */
static vec3 box_corner(vec3 low, vec3 high, unsigned i)
{
    return (vec3){ i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z };
}

void build_box(fm_builder *b, vec3 low, vec3 high)
{
    static const uint8_t faces[6][4] = { { 0, 4, 6, 2 }, { 1, 3, 7, 5 }, { 0, 1, 5, 4 },
                                         { 2, 6, 7, 3 }, { 0, 2, 3, 1 }, { 4, 5, 7, 6 } };
    for (int i = 0; i < 6; i++)
        build_quad(b, box_corner(low, high, faces[i][0]), box_corner(low, high, faces[i][1]),
                   box_corner(low, high, faces[i][2]), box_corner(low, high, faces[i][3]));
}

/* Its vertices, or one where the radius is 0. The profile runs along (along.x, along.y), so that
 * its normal is (along.y, -along.x). */
static uint32_t lathe_ring(fm_builder *b, uint32_t sides, fm_ring ring, vec3 along)
{
    if (!(ring.radius > 0))
        return build_vertex(b, (vec3){ 0, ring.y, 0 }, (vec3){ 0, 1, 0 });
    const uint32_t first = b->vertex_count;
    for (uint32_t i = 0; i < sides; i++) {
        const double turns = (double)i / sides;
        const vec3 out = { turn_cos(turns), 0, turn_sin(turns) };
        build_vertex(b, (vec3){ ring.radius * out.x, ring.y, ring.radius * out.z },
                     (vec3){ along.y * out.x, -along.x, along.y * out.z });
    }
    return first;
}

/* Triangles between two rings, of which one may be a tip. */
static void lathe_band(fm_builder *b, const uint32_t first[2], const bool is_tip[2], uint32_t sides)
{
    for (uint32_t i = 0; i < sides; i++) {
        const uint32_t next = (i + 1) % sides;
        if (!is_tip[0])
            build_triangle(b, first[0] + i, first[0] + next, is_tip[1] ? first[1] : first[1] + i);
        if (!is_tip[1])
            build_triangle(b, first[1] + i, is_tip[0] ? first[0] : first[0] + next,
                           first[1] + next);
    }
}

static void lathe_step(fm_builder *b, uint32_t sides, fm_ring from, fm_ring to)
{
    const vec3 along = { to.radius - from.radius, to.y - from.y, 0 };
    const bool is_tip[2] = { !(from.radius > 0), !(to.radius > 0) };
    uint32_t first[2];
    assert(!is_tip[0] || !is_tip[1]);
    first[0] = lathe_ring(b, sides, from, along);
    first[1] = lathe_ring(b, sides, to, along);
    lathe_band(b, first, is_tip, sides);
}

void build_lathe(fm_builder *b, const fm_lathe *lathe)
{
    const fm_ring *profile = lathe->profile, *last = &profile[lathe->points - 1];
    assert(lathe->points >= 2 && lathe->sides >= 3);
    if (!lathe->is_open && profile->radius > 0)
        lathe_step(b, lathe->sides, (fm_ring){ 0, profile->y }, *profile);
    for (; profile < last; profile++)
        lathe_step(b, lathe->sides, profile[0], profile[1]);
    if (!lathe->is_open && last->radius > 0)
        lathe_step(b, lathe->sides, *last, (fm_ring){ 0, last->y });
}

/* Any direction across. */
static vec3 across(vec3 v)
{
    const vec3 axis = fabs(v.x) < 0.6 ? (vec3){ 1, 0, 0 } : (vec3){ 0, 1, 0 };
    return normalized(cross(v, axis));
}

void build_tube(fm_builder *b, const fm_tube *tube)
{
    double round[8][2];
    vec3 side = { 0 };
    assert(tube->points >= 2 && tube->sides >= 3 && tube->sides <= 8);
    for (uint32_t i = 0; i < tube->sides; i++) {
        round[i][0] = turn_cos((double)i / tube->sides);
        round[i][1] = turn_sin((double)i / tube->sides);
    }
    const uint32_t first = b->vertex_count;
    for (uint32_t p = 0; p < tube->points; p++) {
        const uint32_t before = p > 0 ? p - 1 : 0, after = p + 1 < tube->points ? p + 1 : p;
        const vec3 along = normalized(minus(tube->path[after], tube->path[before]));
        const double radius =
            tube->radius + (tube->tip_radius - tube->radius) * p / (tube->points - 1);
        /* The last side, turned as little as the path turns. */
        side = p == 0 ? across(along) : normalized(plus_scaled(side, along, -dot(side, along)));
        const vec3 other = cross(along, side);
        for (uint32_t i = 0; i < tube->sides; i++) {
            const vec3 out =
                plus_scaled(plus_scaled((vec3){ 0 }, side, round[i][0]), other, round[i][1]);
            build_vertex(b, plus_scaled(tube->path[p], out, radius), out);
        }
    }
    for (uint32_t p = 0; p + 1 < tube->points; p++)
        lathe_band(b, (uint32_t[2]){ first + p * tube->sides, first + (p + 1) * tube->sides },
                   (bool[2]){ false, false }, tube->sides);
}
