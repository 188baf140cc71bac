/* Stand-in for the model of the Minoan palace of Knossos: wings of rooms in terraces around a
 * central court, red columns that taper downwards, horns of consecration on the roofs, on paved
 * ground. Metres; y is up. */
#include <math.h>

#include "procedural.h"

/* Printed for the model; the paving makes up what the buildings leave. */
enum { FACES = 109168 };

static const uint32_t ochre = 0x8CBEE6, plaster = 0xC8DCF0, red = 0x2828B4, black = 0x282828,
                      paving = 0xAABEC8, gypsum = 0xDCE6EB;
/* Solids keep this apart: no two faces lie in one plane. */
static const double joint = 0.02;
static const double storey = 3.6, slab = 0.35, wall = 0.4, room = 5.5;

static void block(fm_builder *b, vec3 low, vec3 size)
{
    build_box(b, low, plus(low, size));
}

/* Wider above than below, as at Knossos; capital and abacus above, a disc of gypsum below. */
static void column(fm_builder *b, double x, double y, double z, double height)
{
    static const fm_ring foot[2] = { { 0.42, 0 }, { 0.42, 0.12 } };
    const fm_ring shaft[2] = { { 0.26, 0.14 }, { 0.36, height - 0.52 } };
    const fm_ring capital[4] = { { 0.34, height - 0.5 },
                                 { 0.5, height - 0.42 },
                                 { 0.5, height - 0.3 },
                                 { 0.38, height - 0.22 } };
    b->pose.origin = (vec3){ x, y, z };
    b->colour = gypsum;
    build_lathe(b, &(fm_lathe){ .profile = foot, .points = 2, .sides = 12 });
    b->colour = red;
    build_lathe(b, &(fm_lathe){ .profile = shaft, .points = 2, .sides = 12 });
    b->colour = black;
    build_lathe(b, &(fm_lathe){ .profile = capital, .points = 4, .sides = 12 });
    build_box(b, (vec3){ -0.5, height - 0.2, -0.5 }, (vec3){ 0.5, height - joint, 0.5 });
    b->pose = FM_POSE_UNIT;
}

/* Two tips that lean outwards from a common foot. */
static void horns(fm_builder *b, double x, double y, double z)
{
    b->colour = gypsum;
    b->pose.origin = (vec3){ x, y, z };
    build_box(b, (vec3){ -0.9, 0, -0.2 }, (vec3){ 0.9, 0.3, 0.2 });
    for (int side = -1; side <= 1; side += 2) {
        static const fm_ring tip[3] = { { 0.26, 0 }, { 0.18, 0.7 }, { 0, 1.2 } };
        b->pose = (fm_pose){
            { x + 0.6 * side, y + 0.3 + joint, z }, { 1, 0, 0 }, { 0.25 * side, 1, 0 }, { 0, 0, 1 }
        };
        build_lathe(b, &(fm_lathe){ .profile = tip, .points = 3, .sides = 8 });
    }
    b->pose = FM_POSE_UNIT;
}

/* A storey of nx by nz rooms, seen from above. */
typedef struct floor_plan {
    double x, y, z; /* its lower corner */
    int nx, nz;
} floor_plan;

/* A wall of length `along` from the frame's origin along local x: whole, with a door, or open. */
static void wall_between(fm_builder *b, double along, bool is_outside)
{
    const double height = storey - slab - 2 * joint, door = 1.3, lintel = 2.4;
    const double chance = builder_random(b);
    const double left = 0.5 * (along - door);
    if (!is_outside && chance < 0.25)
        return;
    if (chance > (is_outside ? 0.3 : 0.6)) {
        block(b, (vec3){ 0, 0, -0.5 * wall }, (vec3){ along, height, wall });
        return;
    }
    block(b, (vec3){ 0, 0, -0.5 * wall }, (vec3){ left, height, wall });
    block(b, (vec3){ along - left, 0, -0.5 * wall }, (vec3){ left, height, wall });
    block(b, (vec3){ left + joint, lintel, -0.5 * wall },
          (vec3){ door - 2 * joint, height - lintel, wall });
}

/* Walls between the pillars of the grid, in x if along_x, else in z. */
static void walls(fm_builder *b, const floor_plan *plan, bool along_x)
{
    const double gap = 0.5 * wall + joint;
    const int across = along_x ? plan->nz : plan->nx, along = along_x ? plan->nx : plan->nz;
    for (int line = 0; line <= across; line++)
        for (int i = 0; i < along; i++) {
            const double from = i * room + gap, beside = line * room;
            b->pose.origin = (vec3){ plan->x + (along_x ? from : beside), plan->y + slab + joint,
                                     plan->z + (along_x ? beside : from) };
            b->pose.x = along_x ? (vec3){ 1, 0, 0 } : (vec3){ 0, 0, 1 };
            b->pose.z = along_x ? (vec3){ 0, 0, 1 } : (vec3){ 1, 0, 0 };
            wall_between(b, room - 2 * gap, line == 0 || line == across);
        }
    b->pose = FM_POSE_UNIT;
}

static void pillars(fm_builder *b, const floor_plan *plan)
{
    for (int i = 0; i <= plan->nx; i++)
        for (int j = 0; j <= plan->nz; j++)
            block(b,
                  (vec3){ plan->x + i * room - 0.5 * wall, plan->y + slab + joint,
                          plan->z + j * room - 0.5 * wall },
                  (vec3){ wall, storey - slab - 2 * joint, wall });
}

/* Floor or roof, wider than the walls below it. */
static void deck(fm_builder *b, const floor_plan *plan, double overhang)
{
    block(b, (vec3){ plan->x - overhang, plan->y, plan->z - overhang },
          (vec3){ plan->nx * room + 2 * overhang, slab, plan->nz * room + 2 * overhang });
}

static void roof_edge(fm_builder *b, const floor_plan *plan)
{
    for (int i = 0; i < plan->nx; i++) {
        horns(b, plan->x + (i + 0.5) * room, plan->y + slab + joint, plan->z);
        horns(b, plan->x + (i + 0.5) * room, plan->y + slab + joint, plan->z + plan->nz * room);
    }
}

/* Storeys on top of one another; each is one room narrower where the wing steps back. */
static void wing(fm_builder *b, floor_plan plan, int storeys, int step_x, int step_z)
{
    build_part(b);
    b->colour = gypsum;
    deck(b, &plan, 0.5);
    for (int i = 0; i < storeys; i++) {
        b->colour = i % 2 == 0 ? ochre : plaster;
        pillars(b, &plan);
        walls(b, &plan, true);
        walls(b, &plan, false);
        plan.y += storey;
        b->colour = red;
        deck(b, &plan, 0.7);
        plan.x += step_x > 0 ? room * step_x : 0;
        plan.z += step_z > 0 ? room * step_z : 0;
        plan.nx -= step_x;
        plan.nz -= step_z;
    }
    plan.nx += step_x;
    plan.nz += step_z;
    plan.x -= step_x > 0 ? room * step_x : 0;
    plan.z -= step_z > 0 ? room * step_z : 0;
    roof_edge(b, &plan);
}

/* count columns from (x, z) on, under a beam. */
static void colonnade(fm_builder *b, vec3 from, vec3 step, int count)
{
    const double height = storey + slab - 0.4;
    build_part(b);
    for (int i = 0; i < count; i++) {
        const vec3 at = plus_scaled(from, step, i);
        column(b, at.x, at.y, at.z, height);
    }
    const vec3 end = plus_scaled(from, step, count - 1);
    b->colour = ochre;
    build_box(b, (vec3){ from.x - 0.5, from.y + height, from.z - 0.5 },
              (vec3){ end.x + 0.5, end.y + height + 0.4, end.z + 0.5 });
}

static void stairs(fm_builder *b, double x, double z, double width, int steps)
{
    build_part(b);
    b->colour = gypsum;
    for (int i = 0; i < steps; i++)
        block(b, (vec3){ x + i * 0.42, 0.18 * i + joint, z }, (vec3){ 0.42 - joint, 0.18, width });
}

/* The paved ground: `faces` triangles, watertight. A grid of squares; what is left of the number
 * are corners more on the outer border of its last row, whose squares become fans. */
typedef struct pavement {
    vec3 low;
    double width, depth;
    uint32_t cells; /* in a row, and rows */
    uint32_t more;  /* corners on the outer border */
} pavement;

static void fan(fm_builder *b, const pavement *p, uint32_t i)
{
    const double step = p->width / p->cells, x = p->low.x + i * step;
    const double near_z = p->low.z + p->depth * (p->cells - 1) / p->cells;
    const double far_z = p->low.z + p->depth;
    const uint32_t corners = p->more / p->cells + (i < p->more % p->cells);
    const uint32_t first = build_vertex(b, (vec3){ x, p->low.y, near_z }, (vec3){ 0, 1, 0 });
    build_vertex(b, (vec3){ p->low.x + (i + 1) * step, p->low.y, near_z }, (vec3){ 0, 1, 0 });
    for (uint32_t c = 0; c <= corners + 1; c++) {
        const double part = 1 - (double)c / (corners + 1);
        build_vertex(b, (vec3){ x + step * part, p->low.y, far_z }, (vec3){ 0, 1, 0 });
        build_triangle(b, first, first + 1 + c, first + 2 + c);
    }
}

static void pave(fm_builder *b, vec3 low, double width, double depth, uint32_t faces)
{
    const uint32_t cells = (uint32_t)sqrt(faces / 2.0);
    const pavement p = { low, width, depth, cells, faces - 2 * cells * cells };
    const double step = width / cells;
    build_part(b);
    b->colour = paving;
    for (uint32_t j = 0; j + 1 < cells; j++)
        for (uint32_t i = 0; i < cells; i++) {
            const double x = low.x + i * step, next_x = low.x + (i + 1) * step;
            const double z = low.z + depth * j / cells, next_z = low.z + depth * (j + 1) / cells;
            build_quad(b, (vec3){ x, low.y, z }, (vec3){ next_x, low.y, z },
                       (vec3){ next_x, low.y, next_z }, (vec3){ x, low.y, next_z });
        }
    for (uint32_t i = 0; i < cells; i++)
        fan(b, &p, i);
}

void palace_build(fm_builder *b)
{
    const double ground = 0.5 * 155.5; /* so that 3.3 surfaces lie behind a used pixel */
    wing(b, (floor_plan){ -14 - 6 * room, joint, -33, 6, 12 }, 2, 1, 0);
    wing(b, (floor_plan){ 14, joint, -33, 6, 12 }, 3, 1, 1);
    wing(b, (floor_plan){ -11, joint, -28 - 3 * room, 4, 3 }, 2, 0, 0);
    wing(b, (floor_plan){ -11, joint, 34, 4, 2 }, 1, 0, 0);
    colonnade(b, (vec3){ -12, joint, -26 }, (vec3){ 0, 0, 3.25 }, 17);
    colonnade(b, (vec3){ 12, joint, -26 }, (vec3){ 0, 0, 3.25 }, 17);
    colonnade(b, (vec3){ -9, joint, -26.5 }, (vec3){ 3, 0, 0 }, 7);
    stairs(b, -54, -10, 8, 12);
    pave(b, (vec3){ -ground, 0, -ground }, 2 * ground, 2 * ground, FACES - builder_triangles(b));
}
