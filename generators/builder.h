/* Builds a mesh from boxes, columns and tubes, block by block: nothing grows with the mesh.
 *
 * A builder without a sink only counts: the same calls then say how large the mesh is, and where it
 * stands. Failures of the sink are kept; what follows one is not handed over. */
#ifndef FM_BUILDER_H
#define FM_BUILDER_H

#include "base/random.h"
#include "base/vec3.h"
#include "scene/scene.h"

enum { BUILDER_BLOCK = 8192 };

/* Where a piece stands: local x, y, z to the scene. Axes may have any length. */
typedef struct fm_pose {
    vec3 origin, x, y, z;
} fm_pose;
#define FM_POSE_UNIT ((fm_pose){ { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } })

typedef struct fm_builder {
    const fm_settings *settings;
    const fm_mesh_sink *sink; /* NULL: counts only */
    fm_error *err;
    fm_status status;
    uint64_t random; /* state: random_next(&b->random) */

    fm_pose pose;    /* of what follows; FM_POSE_UNIT at first */
    uint32_t colour; /* 0xBBGGRR of what follows; FM_STONE at first */

    uint32_t vertex_count, index_count; /* so far */
    uint32_t parts;                     /* so far */
    fm_box box;
    uint32_t vertices_held, indices_held;
    fm_vertex vertices[BUILDER_BLOCK];
    uint32_t indices[BUILDER_BLOCK];
} fm_builder;

/* Everything is borrowed until builder_end, which returns the first failure. */
void builder_begin(fm_builder *b, const fm_settings *settings, const fm_mesh_sink *sink,
                   fm_error *err);
fm_status builder_end(fm_builder *b);

uint32_t builder_triangles(const fm_builder *b);
/* Uniform in [0, 1), in [low, high). */
double builder_random(fm_builder *b);
double builder_between(fm_builder *b, double low, double high);
/* In the box from low to high: x, then y, then z is drawn. C leaves the order open in which a list
 * of initialisers is evaluated; draw from two of them, and a scene depends on the compiler. */
vec3 builder_within(fm_builder *b, vec3 low, vec3 high);

/* Counts what follows as one more part. */
void build_part(fm_builder *b);

/* The number of a new vertex, in local coordinates. */
uint32_t build_vertex(fm_builder *b, vec3 position, vec3 normal);
/* Of vertices that were built; the first one's colour is the triangle's. */
void build_triangle(fm_builder *b, uint32_t i, uint32_t j, uint32_t k);

/* Two triangles with one normal; corners in turn around the border. */
void build_quad(fm_builder *b, vec3 p, vec3 q, vec3 r, vec3 s);
/* Closed: 12 triangles. */
void build_box(fm_builder *b, vec3 low, vec3 high);

typedef struct fm_ring {
    double radius, y;
} fm_ring;

/* A solid of revolution around local y. */
typedef struct fm_lathe {
    const fm_ring *profile; /* [points]; radius 0 is a tip, at the ends only */
    uint32_t points;        /* at least 2 */
    uint32_t sides;         /* at least 3 */
    bool is_open;           /* else flat ends are closed by triangles around a tip */
} fm_lathe;
void build_lathe(fm_builder *b, const fm_lathe *lathe);

/* An n-sided tube along a path; its ends are open. */
typedef struct fm_tube {
    const vec3 *path; /* [points], no two neighbours equal */
    uint32_t points;  /* at least 2 */
    uint32_t sides;   /* 3..8 */
    double radius;
    double tip_radius; /* at the last point; linear between */
} fm_tube;
void build_tube(fm_builder *b, const fm_tube *tube);

#endif
