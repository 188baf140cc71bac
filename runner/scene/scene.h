/* A scene ready to be drawn: what a device needs and nothing else.
 *
 * The room scene holds what scenes are and all that is known of one without a device: files,
 * meshes, cameras, layers in closed form, hulls, the host's rasteriser, sequences of frames. What
 * makes scenes from a seed is generators/'; nothing here knows a generator, a method or a device.
 */
#ifndef FM_SCENE_H
#define FM_SCENE_H

#include "base/error.h"
#include "camera.h"
#include "mesh/facts.h"
#include "model/settings.h"

/* A mesh vertex as the shaders read it. */
typedef struct fm_vertex {
    float position[3]; /* object space: of a file's mesh, in the scene's space */
    uint32_t colour;   /* RGBA8, premultiplied: shaded on the host, the same on every device */
} fm_vertex;
_Static_assert(sizeof(fm_vertex) == 16, "attributes of mesh_vertex.glsl");

/* One layer as methods/common/layers_vertex.glsl reads it. depth(x, y) = depth + slope_x * x +
 * slope_y * y, (x, y) the pixel's position in NDC; what is rasterised, which hand_on.h maps. */
typedef struct fm_layer {
    float depth, slope_x, slope_y;
    uint32_t colour; /* RGBA8, premultiplied */
} fm_layer;
_Static_assert(sizeof(fm_layer) == 16, "std430 struct fm_layer of stage_shader.c");

typedef struct fm_rect {
    uint32_t x0, y0, x1, y1; /* px, half open */
} fm_rect;

/* One fragment of a pixel. */
typedef struct fm_fragment {
    float depth;     /* 0..1, as methods see it (hand_on.h) */
    uint32_t colour; /* RGBA8, premultiplied */
} fm_fragment;

/* Takes a mesh in blocks: all vertices from the first on, and all indices, in any interleaving.
 * What a block points at is borrowed for the call. */
typedef struct fm_mesh_sink {
    void *user;
    fm_status (*vertices)(void *user, uint32_t first, const fm_vertex *vertices, uint32_t count,
                          fm_error *err);
    fm_status (*indices)(void *user, uint32_t first, const uint32_t *indices, uint32_t count,
                         fm_error *err);
} fm_mesh_sink;

/* What a generator filled. Members of the other kind of scene are zero. */
typedef struct fm_scene fm_scene;
struct fm_scene {
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
    fm_vertex *vertices; /* NULL: make_mesh makes them whenever they are asked for */
    /* Hands the whole mesh to the sink, from the settings alone; NULL where vertices are held. */
    fm_status (*make_mesh)(const fm_scene *scene, const fm_mesh_sink *sink, fm_error *err);
    uint32_t vertex_count;
    uint32_t *indices; /* NULL with vertices */
    uint32_t index_count;
    uint32_t parts;          /* of generated meshes: pieces that are one each, such as a column */
    fm_space space;          /* of a mesh from a file; others: {0} */
    fm_mesh_facts facts;     /* the same */
    float *clip_from_object; /* [instances][16], column major; y down, z 0..1 */
    uint32_t instances;
};

static inline bool scene_is_layers(const fm_scene *scene)
{
    return scene->settings.generator == FM_GENERATOR_LAYERS;
}

/* All layers of a cell are drawn before the next cell's. */
static inline bool scene_is_cell_major(const fm_scene *scene)
{
    return scene_is_layers(scene) && scene->settings.order == FM_ORDER_CELL_MAJOR;
}

void scene_destroy(fm_scene *scene);

/* Hands the mesh over: vertex_count vertices, index_count indices. A generated mesh is made block
 * by block and never held as a whole. Returns what the sink failed with. */
fm_status scene_mesh(const fm_scene *scene, const fm_mesh_sink *sink, fm_error *err);
/* For who needs the whole mesh at once (hulls, CPU rasterisers): fills vertices and indices, if
 * they are not there. FM_NO_MEMORY. */
fm_status scene_hold(fm_scene *scene, fm_error *err);

#endif
