#include "frames.h"

#include <stdlib.h>
#include <string.h>

void sequence_destroy(fm_sequence *sequence)
{
    if (sequence != NULL && sequence->destroy != NULL)
        sequence->destroy(sequence);
}

static uint32_t mix(uint32_t mixed, uint32_t word)
{
    mixed = (mixed ^ word) * 0x9E3779B1u;
    return mixed ^ mixed >> 15;
}

uint32_t draw_digest(const fm_draw_call *draw)
{
    return mix(mix(mix(mix(0x811C9DC5u, draw->shader), draw->uniforms), draw->texture),
               draw->texture_version);
}

static fm_status check_draw(const fm_frame *frame, const fm_draw_call *draw, fm_error *err)
{
    if ((draw->flags & ~FM_DRAW_FLAGS_ALL) != 0)
        return fm_fail(err, FM_INVALID, "flags: unknown bits 0x%X",
                       draw->flags & ~FM_DRAW_FLAGS_ALL);
    if ((unsigned)draw->depth_test >= FM_COMPARE_COUNT || (unsigned)draw->mix >= FM_MIX_COUNT)
        return fm_fail(err, FM_INVALID, "depth_test %u, mix %u: at most %d and %d",
                       (unsigned)draw->depth_test, (unsigned)draw->mix, FM_COMPARE_COUNT - 1,
                       FM_MIX_COUNT - 1);
    if (draw->mask > 15)
        return fm_fail(err, FM_INVALID, "mask: %u: at most 15", draw->mask);
    if (draw->clear_depth > FRAMES_DEPTH_MAX)
        return fm_fail(err, FM_INVALID, "clear_depth: %u: at most %d", draw->clear_depth,
                       FRAMES_DEPTH_MAX);
    if (draw->first > frame->triangle_count || draw->count > frame->triangle_count - draw->first)
        return fm_fail(err, FM_INVALID, "triangles %u and %u more: the frame has %u", draw->first,
                       draw->count, frame->triangle_count);
    return FM_OK;
}

static bool corner_is_legal(const fm_corner *corner)
{
    return corner->x >= -FRAMES_COORDINATE_MAX && corner->x <= FRAMES_COORDINATE_MAX &&
           corner->y >= -FRAMES_COORDINATE_MAX && corner->y <= FRAMES_COORDINATE_MAX &&
           corner->z <= FRAMES_DEPTH_MAX;
}

fm_status frame_check(const fm_frame *frame, uint32_t index, fm_error *err)
{
    if (frame->clear_depth > FRAMES_DEPTH_MAX)
        return fm_fail(err, FM_INVALID, "frame %u: clear_depth: %u: at most %d", index,
                       frame->clear_depth, FRAMES_DEPTH_MAX);
    for (uint32_t i = 0; i < frame->draw_count; i++)
        if (check_draw(frame, &frame->draws[i], err) != FM_OK)
            return fm_error_prefix(err, "frame %u: draw call %u", index, i);
    for (uint32_t i = 0; i < frame->triangle_count; i++)
        for (int c = 0; c < 3; c++)
            if (!corner_is_legal(&frame->triangles[i].corners[c]))
                return fm_fail(err, FM_INVALID,
                               "frame %u: triangle %u, corner %d: (%d, %d, %u): positions end at "
                               "%d, depths at %d",
                               index, i, c, frame->triangles[i].corners[c].x,
                               frame->triangles[i].corners[c].y, frame->triangles[i].corners[c].z,
                               FRAMES_COORDINATE_MAX, FRAMES_DEPTH_MAX);
    return FM_OK;
}

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
