#include "frame_builder.h"

#include <stdlib.h>
#include <string.h>

void frame_builder_clear(fm_frame_builder *builder)
{
    builder->frame.draw_count = 0;
    builder->frame.triangle_count = 0;
    builder->frame.clear_colour = 0xFF000000u;
    builder->frame.clear_depth = FRAMES_DEPTH_MAX;
}

/* Room for one more; the list doubles. */
static bool make_room(fm_frame_builder *builder, void **items, uint32_t count, uint32_t *room,
                      size_t bytes)
{
    if (count < *room)
        return true;
    const uint32_t wanted = *room > 0 ? 2 * *room : 64;
    void *grown = wanted > *room ? reallocarray(*items, wanted, bytes) : NULL;
    builder->failed = builder->failed || grown == NULL;
    if (grown == NULL)
        return false;
    *items = grown;
    *room = wanted;
    return true;
}

void frame_builder_draw(fm_frame_builder *builder, const fm_draw_call *draw)
{
    void *draws = builder->frame.draws;
    if (!make_room(builder, &draws, builder->frame.draw_count, &builder->draw_room, sizeof *draw))
        return;
    builder->frame.draws = draws;
    fm_draw_call *added = &builder->frame.draws[builder->frame.draw_count++];
    *added = *draw;
    added->first = builder->frame.triangle_count;
    added->count = 0;
}

void frame_builder_triangle(fm_frame_builder *builder, const fm_triangle *triangle)
{
    void *triangles = builder->frame.triangles;
    if (builder->frame.draw_count == 0 ||
        !make_room(builder, &triangles, builder->frame.triangle_count, &builder->triangle_room,
                   sizeof *triangle))
        return;
    builder->frame.triangles = triangles;
    builder->frame.triangles[builder->frame.triangle_count++] = *triangle;
    builder->frame.draws[builder->frame.draw_count - 1].count++;
}

static fm_corner corner(int32_t x, int32_t y, uint32_t z)
{
    return (fm_corner){ x * FRAMES_SUBPIXELS, y * FRAMES_SUBPIXELS, z, (uint32_t)x << 16,
                        (uint32_t)y << 16 };
}

void frame_builder_quad(fm_frame_builder *builder, const int32_t px[4], uint32_t z)
{
    const fm_corner a = corner(px[0], px[1], z), b = corner(px[2], px[1], z);
    const fm_corner c = corner(px[2], px[3], z), d = corner(px[0], px[3], z);
    frame_builder_triangle(builder, &(fm_triangle){ { a, b, c } });
    frame_builder_triangle(builder, &(fm_triangle){ { a, c, d } });
}

void frame_builder_free(fm_frame_builder *builder)
{
    free(builder->frame.draws);
    free(builder->frame.triangles);
    *builder = (fm_frame_builder){ 0 };
}
