/* What OpenGL's feedback mode returns, as triangles of a frame. */
#ifndef FM_RECORD_POLYGONS_H
#define FM_RECORD_POLYGONS_H

#include "scene/frame_builder.h"

/* Floats of a vertex in GL_3D_COLOR_TEXTURE: x, y, z; red, green, blue, alpha; s, t, r, q. */
enum { POLYGON_FLOATS = 11 };

typedef struct polygon_view {
    uint32_t height_px;                     /* of the window, whose rows OpenGL counts upwards */
    uint32_t texture_width, texture_height; /* texels; 0: none */
    bool has_scissor;
    float left, bottom, right, top; /* of the scissor, px; OpenGL's rows */
} polygon_view;

/* What became of the primitives; sums. */
typedef struct polygon_totals {
    uint64_t triangles;
    uint64_t dropped; /* points, lines, bitmaps, pixel rectangles: they have no place in a stream */
} polygon_totals;

/* Least and largest alpha of all vertices, 0..1. */
typedef struct polygon_alpha {
    float least, most;
} polygon_alpha;

/* Adds the polygons to the builder's last draw call as fans, clipped to the scissor. Feedback clips
 * to the view and culls faces before. u and v are texels, shifted as a whole by the colours of the
 * polygon's corners, so that another colour is another picture. Values that no OpenGL would return
 * end the list. */
polygon_alpha polygons_add(fm_frame_builder *builder, polygon_totals *totals, const float *values,
                           size_t count, const polygon_view *view);

#endif
