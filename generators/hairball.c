/* Stand-in for NVIDIA Research's hairball (S. Laine, T. Karras): hairs that wind outwards from a
 * small core, each a three-sided tube. */
#include <math.h>

#include "procedural.h"

enum { HAIRS = 6000, SEGMENTS = 80, SIDES = 3 };
/* Chosen so that at 1024 x 1024 no line of sight meets more than 180 surfaces, and one does, as the
 * occupancy-maps paper says of the model; its 22 million fragments fit that paper's counts. */
static const double hair_radius = 0.00416;
static const double core_radius = 0.29, step = 0.018;
static const double wobble = 1.1;     /* how much a hair turns between two points, at most */
static const double outwards = 0.014; /* how much it is bent back towards the outside */

static vec3 random_direction(fm_builder *b)
{
    vec3 v;
    do {
        v = builder_within(b, (vec3){ -1, -1, -1 }, (vec3){ 1, 1, 1 });
    } while (dot(v, v) > 1 || dot(v, v) < 0.01);
    return normalized(v);
}

/* The bend of a hair changes slowly, so that it curls instead of shivering. */
static void wind(vec3 path[SEGMENTS + 1], fm_builder *b)
{
    vec3 along = random_direction(b), bend = { 0 };
    path[0] = plus_scaled((vec3){ 0 }, along, core_radius);
    for (int i = 1; i <= SEGMENTS; i++) {
        const vec3 jolt = random_direction(b);
        bend = plus_scaled(plus_scaled((vec3){ 0 }, bend, 0.85), jolt, 0.15 * wobble);
        along = plus_scaled(along, normalized(path[i - 1]), outwards);
        along = normalized(plus(along, cross(bend, along)));
        path[i] = plus_scaled(path[i - 1], along, step);
    }
}

static uint32_t hair_colour(fm_builder *b)
{
    static const uint32_t colours[8] = { 0x3C64B4, 0x4678C8, 0x325090, 0x5A8CD2,
                                         0x284878, 0x6EA0DC, 0x4B6EAA, 0x82B4E6 };
    return colours[(int)(8 * builder_random(b))];
}

void hairball_build(fm_builder *b)
{
    vec3 path[SEGMENTS + 1];
    for (int i = 0; i < HAIRS; i++) {
        build_part(b);
        b->colour = hair_colour(b);
        wind(path, b);
        build_tube(b, &(fm_tube){ .path = path,
                                  .points = SEGMENTS + 1,
                                  .sides = SIDES,
                                  .radius = hair_radius,
                                  .tip_radius = hair_radius });
    }
}
