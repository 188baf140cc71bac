/* Stand-in for the Greek temple: a Doric peripteros of 6 by 13 columns on three steps. y is up;
 * metres. */
#include "procedural.h"

enum { FRONT = 6, SIDE = 13, FLUTES = 20 };
static const double apart = 2.6, height = 6.0, joint = 0.01;
static const uint32_t marble = 0xD7E6EB, tile = 0x6E8CC8, blue = 0xA06E46;

static double half_front(void)
{
    return 0.5 * apart * (FRONT - 1);
}

static double half_side(void)
{
    return 0.5 * apart * (SIDE - 1);
}

/* With entasis: thinner above, and a little bellied. */
static void column(fm_builder *b, double x, double z, double scale)
{
    enum { RINGS = 9 };
    fm_ring shaft[RINGS];
    const double foot = 0.62 * scale, top = height * scale;
    const fm_ring echinus[4] = { { 0.75 * foot, top - 0.8 * scale },
                                 { 1.15 * foot, top - 0.5 * scale },
                                 { 1.2 * foot, top - 0.42 * scale },
                                 { 1.1 * foot, top - 0.4 * scale } };
    for (int i = 0; i < RINGS; i++) {
        const double t = (double)i / (RINGS - 1);
        shaft[i].radius = foot * (1 - 0.26 * t * (0.7 + 0.3 * t));
        shaft[i].y = joint + (top - 0.82 * scale - joint) * t;
    }
    build_part(b);
    b->pose.origin = (vec3){ x, 0, z };
    b->colour = marble;
    build_lathe(b, &(fm_lathe){ .profile = shaft, .points = RINGS, .sides = FLUTES });
    build_lathe(b, &(fm_lathe){ .profile = echinus, .points = 4, .sides = FLUTES });
    build_box(b, (vec3){ -1.2 * foot, top - 0.38 * scale, -1.2 * foot },
              (vec3){ 1.2 * foot, top - joint, 1.2 * foot });
    b->pose.origin = (vec3){ 0 };
}

static void colonnade(fm_builder *b)
{
    for (int i = 0; i < FRONT; i++)
        for (int j = 0; j < SIDE; j++)
            if (i == 0 || j == 0 || i == FRONT - 1 || j == SIDE - 1)
                column(b, apart * i - half_front(), apart * j - half_side(), 1);
    for (int j = 3; j < SIDE - 3; j++) /* of the inner hall */
        for (int i = -1; i <= 1; i += 2)
            column(b, 1.6 * i, apart * j - half_side(), 0.75);
}

static void steps(fm_builder *b)
{
    build_part(b);
    b->colour = marble;
    for (int i = 0; i < 3; i++) {
        const double wide = 1.0 + 0.5 * (i + 1);
        build_box(b, (vec3){ -half_front() - wide, -0.4 * (i + 1) + joint, -half_side() - wide },
                  (vec3){ half_front() + wide, -0.4 * i, half_side() + wide });
    }
}

/* A frame of four beams around the temple: x and z are half sizes of its outside. */
static void ring(fm_builder *b, double x, double z, double low, double high, double thick)
{
    const double inner = z - thick - joint;
    build_part(b);
    for (int side = -1; side <= 1; side += 2) {
        const double x0 = side < 0 ? -x : x - thick, z0 = side < 0 ? -z : z - thick;
        build_box(b, (vec3){ -x, low, z0 }, (vec3){ x, high, z0 + thick });
        build_box(b, (vec3){ x0, low, -inner }, (vec3){ x0 + thick, high, inner });
    }
}

/* One over each column and one between: three ridges each. */
static void triglyphs(fm_builder *b, double x, double z, int count, bool along_x)
{
    b->colour = blue;
    for (int side = -1; side <= 1; side += 2)
        for (int i = 0; i < count; i++)
            for (int ridge = -1; ridge <= 1; ridge++) {
                const double at = 0.5 * apart * i + 0.22 * ridge;
                const vec3 low = along_x ? (vec3){ -x + at - 0.08, 7.02, side * (z + 0.04) - 0.03 }
                                         : (vec3){ side * (x + 0.04) - 0.03, 7.02, -z + at - 0.08 };
                const vec3 size = along_x ? (vec3){ 0.16, 0.95, 0.06 } : (vec3){ 0.06, 0.95, 0.16 };
                build_box(b, low, plus(low, size));
            }
}

static void entablature(fm_builder *b)
{
    const double x = half_front() + 0.7, z = half_side() + 0.7;
    b->colour = marble;
    ring(b, x, z, height, 6.95, 1.4);
    ring(b, x, z, 6.96, 8.0, 1.2);
    build_part(b);
    triglyphs(b, half_front(), z, 2 * FRONT - 1, true);
    triglyphs(b, x, half_side(), 2 * SIDE - 1, false);
    b->colour = marble;
    ring(b, x + 0.4, z + 0.4, 8.01, 8.3, 1.6);
}

/* A wedge along z, from z0 to z1: the gable's triangle. */
static void wedge(fm_builder *b, double half, double low, double rise, const double z[2])
{
    const vec3 near[3] = { { -half, low, z[0] }, { half, low, z[0] }, { 0, low + rise, z[0] } };
    const vec3 far[3] = { { -half, low, z[1] }, { half, low, z[1] }, { 0, low + rise, z[1] } };
    for (int end = 0; end < 2; end++) {
        const vec3 *p = end == 0 ? near : far, out = { 0, 0, 1 };
        const uint32_t first = build_vertex(b, p[0], out);
        build_vertex(b, p[1], out);
        build_vertex(b, p[2], out);
        build_triangle(b, first, first + 1, first + 2);
    }
    for (int i = 0; i < 3; i++)
        build_quad(b, near[i], near[(i + 1) % 3], far[(i + 1) % 3], far[i]);
}

/* Rows of tiles on both slopes, each a little above the last. */
static void roof(fm_builder *b)
{
    enum { ROWS = 12, COLUMNS = 40 };
    const double half = half_front() + 1.3, length = 2 * (half_side() + 1.3), rise = 2.4;
    b->colour = tile;
    for (int side = -1; side <= 1; side += 2) {
        build_part(b);
        for (int row = 0; row < ROWS; row++)
            for (int i = 0; i < COLUMNS; i++) {
                const double z = -0.5 * length + length * i / COLUMNS;
                const double t = (double)row / ROWS, next = t + 1.05 / ROWS;
                const double lift = row % 2 == 0 ? 0.12 : 0.2;
                b->pose = (fm_pose){ { side * half * (1 - t), 8.4 + lift + rise * t, z },
                                     { side * half * (t - next), rise * (next - t), 0 },
                                     { 0, 1, 0 },
                                     { 0, 0, 1 } };
                build_box(b, (vec3){ 0, 0, 0.02 }, (vec3){ 1, 0.06, length / COLUMNS - 0.02 });
            }
    }
    b->pose = FM_POSE_UNIT;
}

static void gables(fm_builder *b)
{
    const double z = half_side() + 0.5, half = half_front() + 1.1;
    b->colour = marble;
    for (int side = -1; side <= 1; side += 2) {
        build_part(b);
        wedge(b, half, 8.32, 2.1, (double[2]){ side * z, side * (z - 0.5) });
    }
}

/* The walls of the inner room, with a door to the front. */
static void cella(fm_builder *b)
{
    const double x = 3.6, z = half_side() - 2 * apart, thick = 0.6, top = height - joint;
    build_part(b);
    b->colour = marble;
    for (int side = -1; side <= 1; side += 2) {
        const double x0 = side < 0 ? -x : x - thick;
        build_box(b, (vec3){ x0, joint, -z }, (vec3){ x0 + thick, top, z });
        build_box(b, (vec3){ side < 0 ? -x + thick + joint : 1.2, joint, z - thick },
                  (vec3){ side < 0 ? -1.2 : x - thick - joint, top, z });
    }
    build_box(b, (vec3){ -x + thick + joint, joint, -z },
              (vec3){ x - thick - joint, top, -z + thick });
    build_box(b, (vec3){ -1.2 + joint, 4.4, z - thick }, (vec3){ 1.2 - joint, top, z });
    build_part(b); /* pedestal of the statue */
    b->colour = blue;
    build_box(b, (vec3){ -1, joint, -z + 2 }, (vec3){ 1, 1.4, -z + 4 });
}

void temple_build(fm_builder *b)
{
    steps(b);
    colonnade(b);
    cella(b);
    entablature(b);
    gables(b);
    roof(b);
}
