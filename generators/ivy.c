/* Stand-in for the ivy: stems that climb the walls of a ruin and end in lobed leaves. Metres; y is
 * up. */
#include "base/random.h"
#include "procedural.h"
#include "turns.h"

enum { STEMS = 760, POINTS = 64, LEAVES = 5, LOBES = 5, WALLS = 3 };
static const double wall_height = 5.0, thickness = 0.5, step = 0.09;
static const double leaf_size = 0.15; /* of a grown one, from its foot to the middle tip */

static const uint32_t stone = 0x96A5AA, bark = 0x324664;

/* The corners of the ruin's wall, seen from above. */
static const vec3 corners[WALLS + 1] = { { -4, 0, 3 }, { -3, 0, -1 }, { 2, 0, -2 }, { 4, 0, 2 } };

/* A place on the wall, followed along its corners: `along` from 0 to WALLS. */
static fm_pose place_of(double along)
{
    const int i = along < 0 ? 0 : along >= WALLS ? WALLS - 1 : (int)along;
    const vec3 from = corners[i], run = minus(corners[i + 1], from), up = { 0, 1, 0 };
    fm_pose f = { .x = normalized(run), .y = up };
    f.z = cross(f.x, f.y);
    f.origin = plus_scaled(from, run, along - i);
    return f;
}

static vec3 on_wall(const fm_pose *f, double height, double off)
{
    return plus_scaled(plus_scaled(f->origin, f->y, height), f->z, off);
}

/* Courses of blocks with a broken upper edge. */
static void ruin(fm_builder *b)
{
    enum { COURSES = 12, BLOCKS = 9 };
    const double high = wall_height / COURSES;
    b->colour = stone;
    for (int i = 0; i < WALLS; i++) {
        const vec3 run = minus(corners[i + 1], corners[i]);
        build_part(b);
        for (int j = 0; j < BLOCKS; j++) {
            const int courses = COURSES - (int)(4 * builder_random(b));
            b->pose = place_of(i);
            b->pose.x = run;
            for (int k = 0; k < courses; k++)
                build_box(b, (vec3){ (j + 0.02) / BLOCKS, (k + 0.02) * high, -thickness },
                          (vec3){ (j + 0.98) / BLOCKS, (k + 0.98) * high, 0 });
        }
    }
    b->pose = FM_POSE_UNIT;
}

/* Five lobes around the foot at the origin, in the local plane z = 0, bent along the middle. */
static void leaf(fm_builder *b)
{
    static const double outline[2 * LOBES + 1][2] = {
        { 0, 0 },       { 0.45, -0.12 },  { 0.32, 0.2 },   { 0.62, 0.45 },
        { 0.25, 0.55 }, { 0, 1 },         { -0.25, 0.55 }, { -0.62, 0.45 },
        { -0.32, 0.2 }, { -0.45, -0.12 }, { 0, 0 }
    };
    const vec3 normal = { 0, 0, 1 };
    const uint32_t middle = build_vertex(b, (vec3){ 0, 0.35, 0 }, normal);
    for (int i = 0; i < 2 * LOBES; i++) {
        const double x = outline[i][0];
        build_vertex(b, (vec3){ x, outline[i][1], 0.4 * x * x }, normal);
    }
    for (uint32_t i = 0; i < 2 * LOBES; i++)
        build_triangle(b, middle, middle + 1 + i, middle + 1 + (i + 1) % (2 * LOBES));
}

static uint32_t leaf_colour(fm_builder *b)
{
    static const uint32_t greens[6] = {
        0x28783C, 0x328C50, 0x1E6432, 0x3CA064, 0x468C3C, 0x50B482
    };
    return greens[random_below(&b->random, 6)];
}

/* Hangs from `foot`, away from the wall. */
static void hang_leaf(fm_builder *b, const fm_pose *wall, vec3 foot)
{
    const double size = leaf_size * builder_between(b, 0.5, 1);
    const vec3 tip = builder_within(b, (vec3){ -0.8, -1, 0.1 }, (vec3){ 0.8, 0.1, 0.9 });
    vec3 out = { .z = 1 };
    out.x = builder_between(b, -0.5, 0.5);
    out.y = builder_between(b, 0, 0.8);
    vec3 y = { 0 }, z = { 0 };
    y = plus_scaled(plus_scaled(plus_scaled(y, wall->x, tip.x), wall->y, tip.y), wall->z, tip.z);
    z = plus_scaled(plus_scaled(plus_scaled(z, wall->x, out.x), wall->y, out.y), wall->z, out.z);
    y = normalized(y);
    const vec3 x = normalized(cross(y, z));
    z = cross(x, y);
    b->colour = leaf_colour(b);
    b->pose = (fm_pose){ foot, plus_scaled((vec3){ 0 }, x, size), plus_scaled((vec3){ 0 }, y, size),
                         plus_scaled((vec3){ 0 }, z, size) };
    leaf(b);
    b->pose = FM_POSE_UNIT;
}

/* The same on the wall's other face. */
static fm_pose behind(fm_pose f)
{
    f.origin = plus_scaled(f.origin, f.z, -thickness);
    f.x = plus_scaled((vec3){ 0 }, f.x, -1);
    f.z = plus_scaled((vec3){ 0 }, f.z, -1);
    return f;
}

/* From the ground up and aside; towards its end it leaves the wall. */
static int climb(vec3 path[POINTS], fm_pose walls[POINTS], fm_builder *b)
{
    const double length = 4.5; /* of a wall, about */
    double along = builder_between(b, 0, WALLS), height = 0, lean = builder_between(b, -0.6, 0.6);
    double off = builder_between(b, 0.02, 0.2);
    const bool is_behind = builder_random(b) < 0.5;
    int i = 0;
    for (; i < POINTS; i++) {
        walls[i] = is_behind ? behind(place_of(along)) : place_of(along);
        path[i] = on_wall(&walls[i], height, off);
        lean += builder_between(b, -0.35, 0.35);
        lean = lean < -1.2 ? -1.2 : lean > 1.2 ? 1.2 : lean;
        along += step * lean / length;
        height += step * (1 - 0.35 * lean * lean);
        off += builder_between(b, -0.02, 0.024);
        off = off < 0.02 ? 0.02 : off;
        if (along < 0.01 || along > WALLS - 0.01 || height > wall_height)
            break;
    }
    return i < POINTS ? i : POINTS;
}

static void stem(fm_builder *b)
{
    vec3 path[POINTS];
    fm_pose walls[POINTS];
    const int points = climb(path, walls, b);
    if (points < 2)
        return;
    build_part(b);
    b->colour = bark;
    build_tube(b, &(fm_tube){ path, (uint32_t)points, 5, 0.012, 0.003 });
    for (int i = 1; i < points; i++)
        for (int j = 0; j < LEAVES; j++)
            hang_leaf(b, &walls[i], plus_scaled(path[i], walls[i].z, builder_between(b, 0, 0.12)));
}

void ivy_build(fm_builder *b)
{
    ruin(b);
    for (int i = 0; i < STEMS; i++)
        stem(b);
}
