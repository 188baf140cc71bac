/* The triangles of a scene, on the host, as the feed `triangles` hands them to methods:
 * methods/common/triangles.glsl is the twin on the device, bit for bit. Meshes are held
 * (scene_hold). */
#ifndef FM_TRIANGLES_H
#define FM_TRIANGLES_H

#include "rasterise.h"
#include "scene.h"

typedef struct fm_clip_triangle {
    fm_clip_corner corners[3];
    uint32_t colour; /* the first corner's: flat */
    uint32_t layer;  /* of a layers scene: which fragments live depends on it */
} fm_clip_triangle;

/* Triangles of one instance of a draw: of one layer, of one cell (cell-major) or of the mesh. */
uint32_t triangles_per_instance(const fm_scene *scene);
/* The triangle of this place in drawing order, below scene->triangles. */
void triangle_of(fm_clip_triangle *triangle, const fm_scene *scene, uint64_t number);
/* 2 / size as shaders are told it: pixels become NDC by one multiplication, on every device. */
float triangles_ndc_step(uint32_t size_px);

/* What a renderer knows from bounding boxes. */
typedef struct fm_triangles_view {
    bool clips;              /* some triangle has to be clipped or dropped before it is set up */
    float nearest, farthest; /* corners between the planes of near and far lie between these, as
                                methods see depths (hand_on.h) */
} fm_triangles_view;

fm_triangles_view triangles_view(const fm_scene *scene);

#endif
