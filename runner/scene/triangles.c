#include "triangles.h"

#include <math.h>

#include "hand_on.h"
#include "layers.h"

/* Corners of the two triangles of a quad (0 1 / 2 3), as stage.c indexes them. */
static const uint32_t quad_corner[2][3] = { { 0, 1, 2 }, { 2, 1, 3 } };

static uint32_t cells(const fm_scene *scene)
{
    return scene->settings.tessellation * scene->settings.tessellation;
}

uint32_t triangles_per_instance(const fm_scene *scene)
{
    if (!scene_is_layers(scene))
        return scene->index_count / 3;
    return 2 * (scene_is_cell_major(scene) ? scene->n : cells(scene));
}

float triangles_ndc_step(uint32_t size_px)
{
    return 2.0f / (float)size_px;
}

static fm_clip_corner layer_corner(const fm_scene *scene, const fm_layer *plane, uint32_t cell,
                                   uint32_t corner)
{
    const uint32_t t = scene->settings.tessellation;
    const fm_rect *rect = &scene->rect;
    const uint32_t x = layers_border(rect->x0, rect->x1, cell % t + (corner & 1u), t);
    const uint32_t y = layers_border(rect->y0, rect->y1, cell / t + (corner >> 1), t);
    const float ndc_x = (float)x * triangles_ndc_step(scene->width_px) - 1.0f;
    const float ndc_y = (float)y * triangles_ndc_step(scene->height_px) - 1.0f;
    return (fm_clip_corner){ ndc_x, ndc_y,
                             plane->depth + plane->slope_x * ndc_x + plane->slope_y * ndc_y, 1.0f };
}

static void layer_triangle(fm_clip_triangle *triangle, const fm_scene *scene, uint64_t number)
{
    const uint32_t instance = (uint32_t)(number / triangles_per_instance(scene));
    const uint32_t primitive = (uint32_t)(number % triangles_per_instance(scene));
    const bool by_cell = scene_is_cell_major(scene);
    const uint32_t cell = by_cell ? instance : primitive / 2;
    const uint32_t arrival = by_cell ? primitive / 2 : instance;
    const uint32_t row = scene->order_rows > 1 ? cell : 0;
    triangle->layer = scene->order[(uint64_t)row * scene->n + arrival];
    triangle->colour = scene->layers[triangle->layer].colour;
    for (int i = 0; i < 3; i++)
        triangle->corners[i] = layer_corner(scene, &scene->layers[triangle->layer], cell,
                                            quad_corner[primitive % 2][i]);
}

/* Columns times position, summed from the left: as mesh_vertex.glsl writes it out. */
static fm_clip_corner mesh_corner(const float matrix[16], const float p[3])
{
    float c[4];
    for (int row = 0; row < 4; row++)
        c[row] =
            matrix[row] * p[0] + matrix[4 + row] * p[1] + matrix[8 + row] * p[2] + matrix[12 + row];
    return (fm_clip_corner){ c[0], c[1], c[2], c[3] };
}

void triangle_of(fm_clip_triangle *triangle, const fm_scene *scene, uint64_t number)
{
    if (scene_is_layers(scene)) {
        layer_triangle(triangle, scene, number);
        return;
    }
    const uint64_t instance = number / triangles_per_instance(scene);
    const uint32_t *index = &scene->indices[number % triangles_per_instance(scene) * 3];
    triangle->layer = 0;
    triangle->colour = scene->vertices[index[0]].colour;
    for (int i = 0; i < 3; i++)
        triangle->corners[i] = mesh_corner(scene->clip_from_object + 16 * instance,
                                           scene->vertices[index[i]].position);
}

/* z / w where the corner lies between the planes of near and far. */
static void add_depth(fm_triangles_view *view, const fm_scene *scene, const fm_clip_corner *corner)
{
    if (!(corner->w > 0 && corner->z >= 0 && corner->z <= corner->w))
        return;
    const float depth = hand_on(scene->settings.depth, corner->z / corner->w);
    view->nearest = fminf(view->nearest, depth);
    view->farthest = fmaxf(view->farthest, depth);
}

fm_triangles_view triangles_view(const fm_scene *scene)
{
    fm_triangles_view view = { .nearest = 1, .farthest = 0 };
    fm_clip_triangle triangle;
    for (uint64_t i = 0; i < scene->triangles; i++) {
        triangle_of(&triangle, scene, i);
        view.clips =
            view.clips || raster_needs_clip(scene->width_px, scene->height_px, triangle.corners);
        for (int j = 0; j < 3; j++)
            add_depth(&view, scene, &triangle.corners[j]);
    }
    if (view.nearest > view.farthest)
        return (fm_triangles_view){ .clips = view.clips, .nearest = 0, .farthest = 1 };
    return view;
}
