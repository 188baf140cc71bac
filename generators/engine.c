/* Stand-in for the radial engine of 195 parts: nine finned cylinders around a crankcase. y is up,
 * the shaft runs along z; a cylinder is about 1 long. */
#include "procedural.h"
#include "turns.h"

enum { CYLINDERS = 9, FINS = 10, PIPE_POINTS = 13 };

static const uint32_t steel = 0xB4AAA0, dark = 0x5A5550, brass = 0x50AADC, copper = 0x3C6EC8,
                      painted = 0x785A3C, white = 0xE6E6E6;

/* Around the frame's y. */
static void turned_part(fm_builder *b, uint32_t colour, const fm_ring *profile, uint32_t points,
                        uint32_t sides)
{
    build_part(b);
    b->colour = colour;
    build_lathe(b, &(fm_lathe){ .profile = profile, .points = points, .sides = sides });
}

/* A disc of the cylinder, whose tips taper. */
static void fin(fm_builder *b, double y, double radius)
{
    const fm_ring profile[4] = {
        { 0.26, y }, { radius, y + 0.006 }, { radius, y + 0.014 }, { 0.26, y + 0.02 }
    };
    turned_part(b, steel, profile, 4, 48);
}

/* A bent pipe through four points, one part. */
static void pipe(fm_builder *b, uint32_t colour, const vec3 p[4], double radius)
{
    vec3 path[PIPE_POINTS];
    for (int i = 0; i < PIPE_POINTS; i++) {
        const double t = (double)i / (PIPE_POINTS - 1), u = 1 - t;
        const double weight[4] = { u * u * u, 3 * u * u * t, 3 * u * t * t, t * t * t };
        path[i] = (vec3){ 0 };
        for (int j = 0; j < 4; j++)
            path[i] = plus_scaled(path[i], p[j], weight[j]);
    }
    build_part(b);
    b->colour = colour;
    build_tube(b, &(fm_tube){ path, PIPE_POINTS, 8, radius, radius });
}

/* Local axes whose y is the cylinder's; shifted and, for valve gear, leaning by `lean` in x. */
static fm_pose leaning(const fm_pose *f, vec3 at, double lean)
{
    fm_pose moved = *f;
    moved.origin =
        plus_scaled(plus_scaled(plus_scaled(f->origin, f->x, at.x), f->y, at.y), f->z, at.z);
    moved.y = normalized(plus_scaled(f->y, f->x, lean));
    moved.x = cross(moved.y, moved.z);
    return moved;
}

/* Rocker box, push rod and spark plug of one valve: side is -1 or 1. */
static void valve_gear(fm_builder *b, const fm_pose *f, double side)
{
    static const fm_ring box[5] = {
        { 0.08, 0 }, { 0.1, 0.03 }, { 0.1, 0.12 }, { 0.07, 0.16 }, { 0, 0.17 }
    };
    static const fm_ring rod[2] = { { 0.022, 0 }, { 0.022, 0.98 } };
    static const fm_ring plug[6] = { { 0.03, 0 },     { 0.03, 0.05 },  { 0.018, 0.06 },
                                     { 0.018, 0.14 }, { 0.024, 0.15 }, { 0.024, 0.2 } };
    b->pose = leaning(f, (vec3){ 0.15 * side, 1.56, 0 }, 0.35 * side);
    turned_part(b, painted, box, 5, 24);
    b->pose = leaning(f, (vec3){ 0.1 * side, 0.6, 0.33 }, 0.08 * side);
    turned_part(b, dark, rod, 2, 12);
    b->pose = leaning(f, (vec3){ 0.2 * side, 1.4, -0.05 }, 1.6 * side);
    turned_part(b, white, plug, 6, 16);
    b->pose = *f;
}

static void cylinder(fm_builder *b, const fm_pose *f)
{
    static const fm_ring barrel[4] = {
        { 0.25, 0.56 }, { 0.25, 1.3 }, { 0.22, 1.31 }, { 0.22, 1.32 }
    };
    static const fm_ring flange[4] = {
        { 0.27, 0.5 }, { 0.34, 0.5 }, { 0.34, 0.545 }, { 0.27, 0.555 }
    };
    static const fm_ring head[5] = {
        { 0.26, 1.33 }, { 0.32, 1.36 }, { 0.3, 1.5 }, { 0.2, 1.58 }, { 0, 1.6 }
    };
    static const vec3 intake[4] = {
        { 0.2, 1.4, -0.2 }, { 0.3, 1.4, -0.5 }, { 0.1, 0.6, -0.6 }, { 0.05, 0.4, -0.5 }
    };
    static const vec3 exhaust[4] = {
        { -0.2, 1.4, -0.2 }, { -0.3, 1.5, -0.4 }, { -0.3, 1.3, -0.7 }, { -0.05, 1.15, -0.72 }
    };
    b->pose = *f;
    turned_part(b, dark, flange, 4, 48);
    turned_part(b, steel, barrel, 4, 48);
    for (int i = 0; i < FINS; i++)
        fin(b, 0.6 + 0.068 * i, i < FINS / 2 ? 0.34 : 0.37);
    turned_part(b, steel, head, 5, 48);
    valve_gear(b, f, -1);
    valve_gear(b, f, 1);
    pipe(b, brass, intake, 0.05);
    pipe(b, copper, exhaust, 0.055);
}

/* What turns around z: local y is z. */
static void body(fm_builder *b)
{
    static const fm_ring crankcase[6] = { { 0.3, -0.42 }, { 0.48, -0.36 }, { 0.52, -0.2 },
                                          { 0.52, 0.25 }, { 0.48, 0.36 },  { 0.3, 0.4 } };
    static const fm_ring nose[6] = { { 0.4, 0.42 }, { 0.38, 0.55 }, { 0.3, 0.7 },
                                     { 0.2, 0.8 },  { 0.14, 0.84 }, { 0.14, 0.9 } };
    static const fm_ring shaft[2] = { { 0.07, 0.92 }, { 0.07, 1.3 } };
    static const fm_ring hub[5] = {
        { 0.1, 1.02 }, { 0.17, 1.04 }, { 0.17, 1.16 }, { 0.1, 1.2 }, { 0.08, 1.2 }
    };
    static const fm_ring rear[7] = { { 0.28, -0.44 }, { 0.46, -0.46 }, { 0.46, -0.62 },
                                     { 0.36, -0.66 }, { 0.36, -0.84 }, { 0.2, -0.95 },
                                     { 0, -0.97 } };
    b->pose = (fm_pose){ { 0, 0, 0 }, { 1, 0, 0 }, { 0, 0, 1 }, { 0, -1, 0 } };
    turned_part(b, painted, crankcase, 6, 72);
    turned_part(b, steel, nose, 6, 72);
    turned_part(b, steel, shaft, 2, 32);
    turned_part(b, dark, hub, 5, 48);
    turned_part(b, dark, rear, 7, 72);
}

/* The ring behind the cylinders that collects the exhaust. */
static void collector(fm_builder *b)
{
    enum { AROUND = 13 };
    fm_ring ring[AROUND];
    for (int i = 0; i < AROUND; i++) {
        ring[i].radius = 1.15 + 0.08 * turn_cos((double)i / (AROUND - 1));
        ring[i].y = -0.72 + 0.08 * turn_sin((double)i / (AROUND - 1));
    }
    build_part(b);
    b->colour = copper;
    build_lathe(b, &(fm_lathe){ .profile = ring, .points = AROUND, .sides = 96, .is_open = true });
}

void engine_build(fm_builder *b)
{
    for (int i = 0; i < CYLINDERS; i++) {
        const double turns = (double)i / CYLINDERS;
        const vec3 out = { turn_sin(turns), turn_cos(turns), 0 };
        const fm_pose f = { { 0, 0, 0 }, { out.y, -out.x, 0 }, out, { 0, 0, 1 } };
        cylinder(b, &f);
    }
    body(b);
    collector(b);
    b->pose = FM_POSE_UNIT;
}
