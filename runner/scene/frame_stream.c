#include "frame_stream.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/text.h"
#include "frame_builder.h"

enum { STREAM_MAX_BYTES = 1 << 30 };

typedef struct open_stream {
    fm_sequence base;
    char *path, *bytes;
    size_t count;
    size_t *starts; /* [frame_count]: of each frame's head */
    fm_stream_costs costs;
    fm_frame_builder builder; /* draw calls with their costs; triangles stay where they are */
} open_stream;

/* A frame's head; false: the file ends before the frame does. */
static bool read_frame_head(fm_stream_frame_head *head, size_t *end, const open_stream *replay,
                            size_t start)
{
    if (replay->count - start < sizeof *head)
        return false;
    memcpy(head, replay->bytes + start, sizeof *head);
    const uint64_t bytes = (uint64_t)head->draw_count * sizeof(fm_draw_call) +
                           (uint64_t)head->triangle_count * sizeof(fm_triangle);
    *end = start + sizeof *head + (size_t)bytes;
    return bytes <= replay->count - start - sizeof *head;
}

static uint16_t replayed_texture_bytes16(uint16_t recorded, const fm_stream_costs *costs)
{
    return (uint16_t)lround(fmin(recorded * costs->texture_bytes, UINT16_MAX));
}

static fm_status make_frame(fm_sequence *sequence, const fm_frame **frame, uint32_t index,
                            fm_error *err)
{
    open_stream *replay = (open_stream *)sequence;
    fm_stream_frame_head head = { 0 };
    size_t end = 0;
    if (!read_frame_head(&head, &end, replay, replay->starts[index]))
        return fm_fail(err, FM_INVALID, "%s: frame %u is cut off", replay->path, index);
    char *at = replay->bytes + replay->starts[index] + sizeof head;
    frame_builder_clear(&replay->builder);
    replay->builder.frame.clear_colour = head.clear_colour;
    replay->builder.frame.clear_depth = head.clear_depth;
    for (uint32_t i = 0; i < head.draw_count; i++, at += sizeof(fm_draw_call)) {
        fm_draw_call draw;
        memcpy(&draw, at, sizeof draw);
        frame_builder_draw(&replay->builder, &draw);
        if (replay->builder.failed)
            return fm_fail(err, FM_NO_MEMORY, "%s: no memory for frame %u", replay->path, index);
        fm_draw_call *added = &replay->builder.frame.draws[i];
        added->first = draw.first;
        added->count = draw.count;
        added->vertex_instructions = replay->costs.vertex_instructions;
        added->fragment_instructions = replay->costs.fragment_instructions;
        added->texture_bytes16 = replayed_texture_bytes16(draw.texture_bytes16, &replay->costs);
    }
    replay->builder.frame.triangles = (fm_triangle *)(void *)at;
    replay->builder.frame.triangle_count = head.triangle_count;
    *frame = &replay->builder.frame;
    return FM_OK;
}

static void destroy(fm_sequence *sequence)
{
    open_stream *replay = (open_stream *)sequence;
    replay->builder.frame.triangles = NULL; /* the file's */
    frame_builder_free(&replay->builder);
    free(replay->starts);
    free(replay->bytes);
    free(replay->path);
    free(replay);
}

static fm_status check_head(fm_stream_head *head, const open_stream *replay, uint32_t wanted,
                            fm_error *err)
{
    if (replay->count < sizeof *head ||
        memcmp(replay->bytes, STREAM_MAGIC, STREAM_MAGIC_BYTES) != 0)
        return fm_fail(err, FM_INVALID, "%s: not a stream of frames", replay->path);
    memcpy(head, replay->bytes, sizeof *head);
    if (head->version != STREAM_VERSION)
        return fm_fail(err, FM_INVALID, "%s: version %u: this program reads %d", replay->path,
                       head->version, STREAM_VERSION);
    if (head->frame_count < wanted)
        return fm_fail(err, FM_INVALID, "%s: sequence_frames = %u: it holds %u", replay->path,
                       wanted, head->frame_count);
    return FM_OK;
}

/* Where frames begin, and that all are there. */
static fm_status find_frames(open_stream *replay, uint32_t wanted, fm_error *err)
{
    fm_stream_head head;
    fm_status status = check_head(&head, replay, wanted, err);
    if (status != FM_OK)
        return status;
    replay->starts = calloc((size_t)wanted + 1, sizeof *replay->starts);
    if (replay->starts == NULL)
        return fm_fail(err, FM_NO_MEMORY, "%s: no memory for %u frames", replay->path, wanted);
    size_t at = sizeof head;
    for (uint32_t i = 0; i < wanted; i++) {
        fm_stream_frame_head frame;
        replay->starts[i] = at;
        if (!read_frame_head(&frame, &at, replay, at))
            return fm_fail(err, FM_INVALID, "%s: frame %u is cut off", replay->path, i);
    }
    replay->base.width_px = head.width_px;
    replay->base.height_px = head.height_px;
    replay->base.frame_count = wanted;
    return FM_OK;
}

fm_status stream_open(fm_sequence **sequence, const char *path, uint32_t frame_count,
                      const fm_stream_costs *costs, fm_error *err)
{
    *sequence = NULL;
    open_stream *made = calloc(1, sizeof *made);
    if (made == NULL)
        return fm_fail(err, FM_NO_MEMORY, "%s: no memory", path);
    made->base.frame = make_frame;
    made->base.destroy = destroy;
    made->costs = *costs;
    made->path = strdup(path);
    fm_status status = made->path != NULL ? FM_OK : fm_fail(err, FM_NO_MEMORY, "%s", path);
    if (status == FM_OK)
        status = text_read_file(&made->bytes, &made->count, path, STREAM_MAX_BYTES, err);
    if (status == FM_OK)
        status = find_frames(made, frame_count, err);
    if (status == FM_OK)
        *sequence = &made->base;
    else
        destroy(&made->base);
    return status;
}
