#include "frames.h"

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
