#include "frame_stream.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/text.h"

enum { STREAM_MAX_BYTES = 1 << 30 };
const char stream_magic[STREAM_MAGIC_BYTES] = { 'f', 'm', 's', 't', 'r', 'e', 'a', 'm' };
_Static_assert(sizeof(fm_stream_head) == 24, "stored as it lies");
_Static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__, "streams are stored as they lie");

typedef struct frame_head {
    uint32_t clear_colour, clear_depth, draw_count, triangle_count;
} frame_head;

/* ---- writing ---- */

static char *partial_path(const char *path)
{
    char *partial = NULL;
    return asprintf(&partial, "%s.partial", path) < 0 ? NULL : partial;
}

fm_status stream_writer_open(fm_stream_writer *writer, const char *path, uint32_t width_px,
                             uint32_t height_px, fm_error *err)
{
    fm_status status = FM_OK;
    char *partial = partial_path(path);
    *writer = (fm_stream_writer){
        .path = strdup(path),
        .head = { .version = STREAM_VERSION, .width_px = width_px, .height_px = height_px }
    };
    memcpy(writer->head.magic, stream_magic, sizeof stream_magic);
    if (partial == NULL || writer->path == NULL)
        status = fm_fail(err, FM_NO_MEMORY, "%s: no memory", path);
    else if ((writer->file = fopen(partial, "wb")) == NULL ||
             fwrite(&writer->head, sizeof writer->head, 1, writer->file) != 1)
        status = fm_fail(err, FM_IO, "%s: %s", partial, strerror(errno));
    free(partial);
    if (status != FM_OK)
        stream_writer_close(writer, NULL);
    return status;
}

static bool write_items(FILE *file, const void *items, size_t bytes, uint32_t count)
{
    return count == 0 || fwrite(items, bytes, count, file) == count;
}

fm_status stream_writer_add(fm_stream_writer *writer, const fm_frame *frame, fm_error *err)
{
    const frame_head head = { frame->clear_colour, frame->clear_depth, frame->draw_count,
                              frame->triangle_count };
    if (!write_items(writer->file, &head, sizeof head, 1) ||
        !write_items(writer->file, frame->draws, sizeof *frame->draws, frame->draw_count) ||
        !write_items(writer->file, frame->triangles, sizeof *frame->triangles,
                     frame->triangle_count))
        return fm_fail(err, FM_IO, "%s: %s", writer->path, strerror(errno));
    writer->head.frame_count++;
    return FM_OK;
}

/* The head with its count, and the file's own name. */
static fm_status finish_file(fm_stream_writer *writer, const char *partial, fm_error *err)
{
    const bool is_whole = fseek(writer->file, 0, SEEK_SET) == 0 &&
                          fwrite(&writer->head, sizeof writer->head, 1, writer->file) == 1;
    const bool is_closed = fclose(writer->file) == 0;
    writer->file = NULL;
    if (writer->head.frame_count == 0) {
        unlink(partial);
        return FM_OK;
    }
    if (!is_whole || !is_closed || rename(partial, writer->path) != 0)
        return fm_fail(err, FM_IO, "%s: %s", writer->path, strerror(errno));
    return FM_OK;
}

fm_status stream_writer_close(fm_stream_writer *writer, fm_error *err)
{
    fm_status status = FM_OK;
    char *partial = writer->path != NULL ? partial_path(writer->path) : NULL;
    if (writer->file != NULL && partial != NULL)
        status = finish_file(writer, partial, err);
    else if (writer->file != NULL)
        fclose(writer->file);
    free(partial);
    free(writer->path);
    *writer = (fm_stream_writer){ 0 };
    return status;
}

/* ---- replay ---- */

typedef struct stream {
    fm_sequence base;
    char *path, *bytes;
    size_t count;
    size_t *starts; /* [frame_count]: of each frame's head */
    fm_stream_costs costs;
    fm_frame_builder builder; /* draw calls with their costs; triangles stay where they are */
} stream;

/* A frame's head; false: the file ends before the frame does. */
static bool read_frame_head(frame_head *head, size_t *end, const stream *of, size_t start)
{
    if (of->count - start < sizeof *head)
        return false;
    memcpy(head, of->bytes + start, sizeof *head);
    const uint64_t bytes = (uint64_t)head->draw_count * sizeof(fm_draw_call) +
                           (uint64_t)head->triangle_count * sizeof(fm_triangle);
    *end = start + sizeof *head + (size_t)bytes;
    return bytes <= of->count - start - sizeof *head;
}

static uint16_t replayed_texture_bytes16(uint16_t recorded, const fm_stream_costs *costs)
{
    return (uint16_t)lround(fmin(recorded * costs->texture_bytes, UINT16_MAX));
}

static fm_status make_frame(fm_sequence *sequence, const fm_frame **frame, uint32_t index,
                            fm_error *err)
{
    stream *of = (stream *)sequence;
    frame_head head = { 0 };
    size_t end = 0;
    if (!read_frame_head(&head, &end, of, of->starts[index]))
        return fm_fail(err, FM_INVALID, "%s: frame %u is cut off", of->path, index);
    char *at = of->bytes + of->starts[index] + sizeof head;
    frame_builder_clear(&of->builder);
    of->builder.frame.clear_colour = head.clear_colour;
    of->builder.frame.clear_depth = head.clear_depth;
    for (uint32_t i = 0; i < head.draw_count; i++, at += sizeof(fm_draw_call)) {
        fm_draw_call draw;
        memcpy(&draw, at, sizeof draw);
        frame_builder_draw(&of->builder, &draw);
        if (of->builder.failed)
            return fm_fail(err, FM_NO_MEMORY, "%s: no memory for frame %u", of->path, index);
        fm_draw_call *added = &of->builder.frame.draws[i];
        added->first = draw.first;
        added->count = draw.count;
        added->vertex_instructions = of->costs.vertex_instructions;
        added->fragment_instructions = of->costs.fragment_instructions;
        added->texture_bytes16 = replayed_texture_bytes16(draw.texture_bytes16, &of->costs);
    }
    of->builder.frame.triangles = (fm_triangle *)(void *)at;
    of->builder.frame.triangle_count = head.triangle_count;
    *frame = &of->builder.frame;
    return FM_OK;
}

static void destroy(fm_sequence *sequence)
{
    stream *of = (stream *)sequence;
    of->builder.frame.triangles = NULL; /* the file's */
    frame_builder_free(&of->builder);
    free(of->starts);
    free(of->bytes);
    free(of->path);
    free(of);
}

static fm_status check_head(fm_stream_head *head, const stream *of, uint32_t wanted, fm_error *err)
{
    if (of->count < sizeof *head || memcmp(of->bytes, stream_magic, sizeof stream_magic) != 0)
        return fm_fail(err, FM_INVALID, "%s: not a stream of frames", of->path);
    memcpy(head, of->bytes, sizeof *head);
    if (head->version != STREAM_VERSION)
        return fm_fail(err, FM_INVALID, "%s: version %u: this program reads %d", of->path,
                       head->version, STREAM_VERSION);
    if (head->frame_count < wanted)
        return fm_fail(err, FM_INVALID, "%s: sequence_frames = %u: it holds %u", of->path, wanted,
                       head->frame_count);
    return FM_OK;
}

/* Where frames begin, and that all are there. */
static fm_status find_frames(stream *of, uint32_t wanted, fm_error *err)
{
    fm_stream_head head;
    fm_status status = check_head(&head, of, wanted, err);
    if (status != FM_OK)
        return status;
    of->starts = calloc((size_t)wanted + 1, sizeof *of->starts);
    if (of->starts == NULL)
        return fm_fail(err, FM_NO_MEMORY, "%s: no memory for %u frames", of->path, wanted);
    size_t at = sizeof head;
    for (uint32_t i = 0; i < wanted; i++) {
        frame_head frame;
        of->starts[i] = at;
        if (!read_frame_head(&frame, &at, of, at))
            return fm_fail(err, FM_INVALID, "%s: frame %u is cut off", of->path, i);
    }
    of->base.width_px = head.width_px;
    of->base.height_px = head.height_px;
    of->base.frame_count = wanted;
    return FM_OK;
}

fm_status stream_open(fm_sequence **sequence, const char *path, uint32_t frame_count,
                      const fm_stream_costs *costs, fm_error *err)
{
    *sequence = NULL;
    stream *made = calloc(1, sizeof *made);
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
