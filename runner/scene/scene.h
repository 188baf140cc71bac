/* A scene ready to be drawn: what a device needs and nothing else. */
#ifndef FM_SCENE_H
#define FM_SCENE_H

#include "base/error.h"
#include "camera.h"
#include "model/settings.h"

/* A mesh vertex as the shaders read it. */
typedef struct fm_vertex {
    float position[3]; /* object space */
    uint32_t colour;   /* RGBA8, premultiplied: shaded on the host, the same on every device */
} fm_vertex;
_Static_assert(sizeof(fm_vertex) == 16, "attributes of mesh_vertex.glsl");

/* One layer as methods/common/layers_vertex.glsl reads it. depth(x, y) = depth + slope_x * x +
 * slope_y * y, (x, y) the pixel's position in NDC. */
typedef struct fm_layer {
    float depth, slope_x, slope_y;
    uint32_t colour; /* RGBA8, premultiplied */
} fm_layer;
_Static_assert(sizeof(fm_layer) == 16, "std430 struct fm_layer of stage_shader.c");

typedef struct fm_rect {
    uint32_t x0, y0, x1, y1; /* px, half open */
} fm_rect;

typedef struct fm_scene {
    fm_settings settings;
    uint32_t width_px, height_px;
    char hash[17];
    uint64_t triangles;
    uint32_t n; /* layers: n; mesh: 0, known only from truth */

    /* layers */
    fm_layer *layers;            /* [n], by depth rank, nearest first */
    uint32_t *order;             /* [order_rows][n]: arrival slot -> layer */
    uint32_t order_rows;         /* 1, or one for each cell (random-cell) */
    fm_rect rect;                /* covered pixels */
    uint32_t survival_threshold; /* a fragment lives iff hash < threshold; 0xFFFFFFFF: all live */

    /* mesh; read through scene_mesh */
    fm_vertex *vertices; /* NULL: generated whenever they are asked for; see scene_hold */
    uint32_t vertex_count;
    uint32_t *indices; /* NULL with vertices */
    uint32_t index_count;
    uint32_t parts;          /* of generated meshes: pieces that are one each, such as a column */
    float *clip_from_object; /* [instances][16], column major; y down, z 0..1 */
    uint32_t instances;
} fm_scene;

static inline bool scene_is_layers(const fm_scene *scene)
{
    return scene->settings.generator == FM_GENERATOR_LAYERS;
}

/* All layers of a cell are drawn before the next cell's. */
static inline bool scene_is_cell_major(const fm_scene *scene)
{
    return scene_is_layers(scene) && scene->settings.order == FM_ORDER_CELL_MAJOR;
}

/* Builds the scene that settings describe; settings must have passed settings_finish.
 * FM_IO, FM_INVALID: meshes that are missing, empty, truncated, not finite or badly indexed. Of an
 * OBJ file, which states no counts, only what is cut within a line or refers to lost vertices
 * shows. FM_INVALID, FM_NO_MEMORY: scenes too large to hold. */
fm_status scene_create(fm_scene **scene, const fm_settings *settings, fm_error *err);
void scene_destroy(fm_scene *scene);

/* Takes a mesh in blocks: all vertices from the first on, and all indices, in any interleaving.
 * What a block points at is borrowed for the call. */
typedef struct fm_mesh_sink {
    void *user;
    fm_status (*vertices)(void *user, uint32_t first, const fm_vertex *vertices, uint32_t count,
                          fm_error *err);
    fm_status (*indices)(void *user, uint32_t first, const uint32_t *indices, uint32_t count,
                         fm_error *err);
} fm_mesh_sink;

/* Hands the mesh over: vertex_count vertices, index_count indices. A generated mesh is made block
 * by block and never held as a whole. Returns what the sink failed with. */
fm_status scene_mesh(const fm_scene *scene, const fm_mesh_sink *sink, fm_error *err);
/* For who needs the whole mesh at once (hulls, CPU rasterisers): fills vertices and indices, if
 * they are not there. FM_NO_MEMORY. */
fm_status scene_hold(fm_scene *scene, fm_error *err);

/* The layers generator: fills rect, layers, order, survival_threshold (generators/layers.c).
 *
 * Which fragments live, bit for bit the same in C and GLSL:
 *
 *     uint32_t h = x + y * 0x9E3779B1u + layer * 0x85EBCA77u + seed32 * 0xC2B2AE3Du;
 *     h ^= h >> 16; h *= 0x7FEB352Du; h ^= h >> 15; h *= 0x846CA68Bu; h ^= h >> 16;
 *     lives = h < survival_threshold;
 *
 * x, y pixel; layer its rank in `layers`; seed32 = (uint32_t)(seed ^ seed >> 32). At threshold
 * 0xFFFFFFFF all live and the test is skipped. Cells of a tessellation t go row by row:
 * cell = cell_y * t + cell_x, which is also the row of `order` that random-cell uses. */
fm_status layers_generate(fm_scene *scene, fm_error *err);
/* Where cell i of t begins, in px, and cell i - 1 ends; i = 0..t. begin, end: rect's x0, x1 or y0,
 * y1. Cells of less than a pixel may be empty. */
uint32_t layers_border(uint32_t begin, uint32_t end, uint32_t i, uint32_t t);
/* Whether that fragment lives; all fragments of other generators do. */
bool layers_lives(const fm_scene *scene, uint32_t x, uint32_t y, uint32_t layer);
/* The mesh loader: fills vertices and indices (runner/scene/mesh.c). Vertices have a stone base
 * colour, shaded with settings.alpha. box: of the vertices that triangles use. */
fm_status mesh_read(fm_scene *scene, fm_box *box, fm_error *err);
/* Sees instances of a mesh with this box: fills clip_from_object, instances, triangles
 * (runner/scene/placement.c). The box that camera and planes are fitted to holds all instances;
 * instance i is moved by i * instance_offset * the size of the mesh's own box. camera: whose eye
 * ... zoom and instances are read; usually scene->settings. FM_INVALID: no camera sees it, or it is
 * beyond a float's range. */
fm_status scene_place(fm_scene *scene, const fm_settings *camera, const fm_box *box, fm_error *err);

/* Closed form of a layers scene: the fragments of one pixel in arrival order; room for scene->n.
 * Returns how many. Flat layers are exact; the depth of sloped ones is evaluated in double and
 * rounded once, which a rasteriser's interpolation may miss by 2 steps of 2^-24 (more ulp where
 * depths are small). */
typedef struct fm_fragment {
    float depth;
    uint32_t colour;
} fm_fragment;
uint32_t layers_fragments(fm_fragment *fragments, const fm_scene *scene, uint32_t x, uint32_t y);
/* Whether two layers may share a depth at a pixel, or swap places. */
bool layers_tie(const fm_scene *scene);
/* The same fragments nearest first; only where layers do not tie. */
uint32_t layers_sorted(fm_fragment *fragments, const fm_scene *scene, uint32_t x, uint32_t y);

#endif
