/* Frames put together draw call by draw call: what generators, recordings and the recorder use. */
#ifndef FM_FRAME_BUILDER_H
#define FM_FRAME_BUILDER_H

#include "frames.h"

/* A frame that grows. Starts as {0}; cleared, it keeps its memory. */
typedef struct fm_frame_builder {
    fm_frame frame;
    uint32_t draw_room, triangle_room;
    bool failed; /* no memory: sticks */
} fm_frame_builder;

void frame_builder_clear(fm_frame_builder *builder);
/* Triangles that follow are this draw call's; its first and count are set here. */
void frame_builder_draw(fm_frame_builder *builder, const fm_draw_call *draw);
void frame_builder_triangle(fm_frame_builder *builder, const fm_triangle *triangle);
/* Two triangles over [x0, x1) x [y0, y1) px at depth z, coloured by where they are. */
void frame_builder_quad(fm_frame_builder *builder, const int32_t px[4], uint32_t z);
void frame_builder_free(fm_frame_builder *builder);

#endif
