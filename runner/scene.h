/* A scene ready to be drawn: what a device needs and nothing else. */
#ifndef FM_SCENE_H
#define FM_SCENE_H

#include "error.h"
#include "settings.h"

/* A mesh vertex as the shaders read it. */
typedef struct fm_vertex {
    float position[3]; /* object space */
    uint32_t colour;   /* RGBA8, premultiplied: shaded on the host, the same on every device */
} fm_vertex;
_Static_assert(sizeof(fm_vertex) == 16, "vertex stride of mesh.glsl");

/* One layer as generators/layers.glsl reads it. depth(x, y) = depth + slope_x * x + slope_y * y,
 * (x, y) the pixel's position in NDC. */
typedef struct fm_layer {
    float depth, slope_x, slope_y;
    uint32_t colour; /* RGBA8, premultiplied */
} fm_layer;
_Static_assert(sizeof(fm_layer) == 16, "std430 struct of layers.glsl");

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
    fm_layer *layers;       /* [n], by depth rank, nearest first */
    uint32_t *order;        /* [order_rows][n]: arrival slot -> layer */
    uint32_t order_rows;    /* 1, or one for each cell (random-cell) */
    fm_rect rect;           /* covered pixels */
    uint32_t survival_threshold; /* a fragment lives iff hash < threshold; 0xFFFFFFFF: all live */

    /* mesh */
    fm_vertex *vertices;
    uint32_t vertex_count;
    uint32_t *indices;
    uint32_t index_count;
    float *clip_from_object; /* [instances][16], column major */
    uint32_t instances;
} fm_scene;

/* Builds the scene that settings describe; settings must have passed settings_finish.
 * FM_IO, FM_INVALID: meshes that are missing, empty, truncated, not finite or badly indexed. */
fm_status scene_create(fm_scene **scene, const fm_settings *settings, fm_error *err);
void scene_destroy(fm_scene *scene);

/* The layers generator: fills rect, layers, order, survival_threshold (generators/layers.c). */
fm_status layers_generate(fm_scene *scene, fm_error *err);
/* The mesh loader: fills vertices, indices, clip_from_object (runner/mesh.c). */
fm_status mesh_load(fm_scene *scene, fm_error *err);

/* Closed form of a layers scene: the fragments of one pixel in arrival order; room for scene->n.
 * Returns how many. The same integer hash as layers.glsl decides which live. */
typedef struct fm_fragment {
    float depth;
    uint32_t colour;
} fm_fragment;
uint32_t layers_fragments(fm_fragment *fragments, const fm_scene *scene, uint32_t x, uint32_t y);

#endif
