/* Stand-in for the hotel: storeys of furnished rooms on both sides of a corridor, with balconies.
 * Metres; x runs along the corridor, y is up. */
#include "procedural.h"

enum { STOREYS = 10, ROOMS = 23, BARS = 24 };
static const double room_x = 4.2, room_z = 6.0, corridor = 2.0, storey = 3.0;
static const double slab = 0.25, wall = 0.15, joint = 0.01;

static const uint32_t concrete = 0xC8D2D7, plaster = 0xB9DCF0, wood = 0x3C6496, linen = 0xF0F0EB,
                      cloth = 0x9646A0, glass = 0xE6C8A0, metal = 0x646464, light = 0x8CD2FF;

static void block(fm_builder *b, double x, double y, double z, double wide, double high,
                  double deep)
{
    build_box(b, (vec3){ x, y, z }, (vec3){ x + wide, y + high, z + deep });
}

/* x, z: the corner; a top on four legs. */
static void table(fm_builder *b, double x, double z, double wide, double high, double deep)
{
    const double leg = 0.06;
    build_part(b);
    b->colour = wood;
    block(b, x, high - 0.05, z, wide, 0.05, deep);
    for (int i = 0; i < 4; i++)
        block(b, i & 1 ? x + wide - leg : x, joint, i & 2 ? z + deep - leg : z, leg,
              high - 0.05 - 2 * joint, leg);
}

static void chair(fm_builder *b, double x, double z)
{
    table(b, x, z, 0.45, 0.45, 0.45);
    b->colour = cloth;
    block(b, x, 0.46, z, 0.05, 0.5, 0.45);
}

static void lamp(fm_builder *b, double x, double y, double z)
{
    static const fm_ring foot[4] = {
        { 0.08, 0 }, { 0.08, 0.02 }, { 0.015, 0.03 }, { 0.015, 0.25 }
    };
    static const fm_ring shade[2] = { { 0.16, 0.2 }, { 0.09, 0.42 } };
    const fm_pose room = b->pose;
    build_part(b);
    b->pose.origin = (vec3){ room.origin.x + x, room.origin.y + y, room.origin.z + room.z.z * z };
    b->colour = metal;
    build_lathe(b, &(fm_lathe){ .profile = foot, .points = 4, .sides = 12 });
    b->colour = light;
    build_lathe(b, &(fm_lathe){ .profile = shade, .points = 2, .sides = 16, .is_open = true });
    b->pose = room;
}

static void bed(fm_builder *b, double x, double z)
{
    build_part(b);
    b->colour = wood;
    block(b, x, 0.1, z, 2.0, 0.2, 1.7);
    block(b, x - 0.06, joint, z - 0.05, 0.05, 1.0, 1.8);
    b->colour = linen;
    block(b, x + 0.02, 0.31, z + 0.02, 1.96, 0.22, 1.66);
    for (int i = 0; i < 2; i++)
        block(b, x + 0.1, 0.54, z + 0.12 + 0.8 * i, 0.45, 0.12, 0.62);
    b->colour = cloth;
    block(b, x + 0.8, 0.54, z, 1.15, 0.04, 1.7);
}

/* What stands in a room differs a little from room to room. */
static void furniture(fm_builder *b)
{
    const double shift = builder_between(b, 0, 0.4);
    bed(b, 0.3, 2.6 + shift);
    table(b, 0.3, 2.0 + shift, 0.45, 0.5, 0.45);
    lamp(b, 0.52, 0.51, 2.22 + shift);
    table(b, 2.9, 4.2 + shift, 1.0, 0.75, 0.6);
    lamp(b, 3.6, 0.76, 4.5 + shift);
    chair(b, 2.6 - shift, 4.9);
    build_part(b); /* wardrobe: two doors before a case */
    b->colour = wood;
    block(b, 2.4, joint, 0.2, 1.5, 2.1, 0.55);
    b->colour = plaster;
    block(b, 2.42, 0.1, 0.77, 0.72, 1.9, 0.03);
    block(b, 3.16, 0.1, 0.77, 0.72, 1.9, 0.03);
}

/* Carpet, two pictures, curtains in folds, and a lamp below the ceiling. */
static void decoration(fm_builder *b)
{
    static const fm_ring globe[5] = {
        { 0, 2.2 }, { 0.15, 2.26 }, { 0.2, 2.36 }, { 0.12, 2.46 }, { 0.03, 2.5 }
    };
    const fm_pose room = b->pose;
    build_part(b);
    b->colour = cloth;
    block(b, 1.0, joint, 2.3, 2.4, 0.02, 2.8);
    for (int i = 0; i < 5; i++) {
        block(b, 0.3 + 0.12 * i, 0.15, room_z - 0.35 + 0.06 * (i % 2), 0.1, 2.2, 0.03);
        block(b, 3.3 + 0.12 * i, 0.15, room_z - 0.35 + 0.06 * (i % 2), 0.1, 2.2, 0.03);
    }
    b->colour = wood;
    block(b, wall + joint, 1.4, 3.0, 0.03, 0.6, 0.9);
    block(b, room_x - 0.06, 1.4, 2.4, 0.03, 0.7, 0.7);
    b->colour = light;
    b->pose.origin = (vec3){ room.origin.x + 2.1, room.origin.y, room.origin.z + room.z.z * 3.4 };
    build_lathe(b, &(fm_lathe){ .profile = globe, .points = 5, .sides = 16 });
    b->pose = room;
}

/* The bath beside the door: two thin walls, tub and basin. */
static void bath(fm_builder *b)
{
    build_part(b);
    b->colour = plaster;
    block(b, 0.2, joint, 1.75, 1.75, storey - slab - 2 * joint, 0.08);
    block(b, 1.96, joint, 0.2, 0.08, storey - slab - 2 * joint, 1.63);
    b->colour = linen;
    block(b, 0.3, joint, 0.3, 0.75, 0.5, 1.35);
    block(b, 1.3, 0.6, 0.25, 0.55, 0.2, 0.4);
}

/* Window front and balcony, at the far end of the room. */
static void front(fm_builder *b)
{
    const double z = room_z - 0.1;
    build_part(b);
    b->colour = glass;
    for (int i = 0; i < 3; i++)
        block(b, wall + 0.05 + 1.3 * i, 0.1, z, 1.25, 2.3, 0.03);
    b->colour = concrete;
    block(b, wall, 2.42, z - 0.05, room_x - 2 * wall, storey - slab - 2.44, 0.15);
    block(b, 0.1, -slab, room_z + 0.2, room_x - 0.2, 0.18, 1.3);
    b->colour = metal;
    for (int i = 0; i <= BARS; i++)
        block(b, 0.15 + (room_x - 0.33) * i / BARS, 0.0, room_z + 1.42, 0.03, 1.0, 0.03);
    block(b, 0.12, 1.01, room_z + 1.4, room_x - 0.24, 0.05, 0.07);
}

/* The wall to the corridor with its door, and the one to the next room. */
static void room_walls(fm_builder *b)
{
    const double high = storey - slab - 2 * joint;
    build_part(b);
    b->colour = plaster;
    block(b, wall, joint, 0, 1.9, high, wall);
    block(b, wall + 2.8, joint, 0, room_x - 2.8 - wall - joint, high, wall);
    block(b, wall + 1.9 + joint, 2.1, 0, 0.9 - 2 * joint, high - 2.1, wall);
    block(b, 0, joint, 0, wall - joint, high, room_z - 0.15);
    b->colour = wood;
    block(b, wall + 1.95, 0.02, 0.05, 0.8, 2.05, 0.05);
}

static void floor_of(fm_builder *b, int number)
{
    const double deep = 2 * room_z + corridor;
    b->pose = FM_POSE_UNIT;
    b->pose.origin = (vec3){ 0, number * storey - slab, 0 };
    build_part(b);
    b->colour = concrete;
    block(b, -0.4, 0, -0.5 * deep - 0.15, ROOMS * room_x + 0.8, slab - joint, deep + 0.3);
}

void hotel_build(fm_builder *b)
{
    for (int level = 0; level < STOREYS; level++) {
        floor_of(b, level);
        for (int side = -1; side <= 1; side += 2)
            for (int i = 0; i < ROOMS; i++) {
                b->pose = (fm_pose){ { i * room_x, level * storey, 0.5 * corridor * side },
                                     { 1, 0, 0 },
                                     { 0, 1, 0 },
                                     { 0, 0, side } };
                room_walls(b);
                bath(b);
                furniture(b);
                decoration(b);
                front(b);
            }
    }
    floor_of(b, STOREYS);
    b->pose = FM_POSE_UNIT;
}
