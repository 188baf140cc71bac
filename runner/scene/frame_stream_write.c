#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "frame_stream.h"

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
    memcpy(writer->head.magic, STREAM_MAGIC, STREAM_MAGIC_BYTES);
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
    const fm_stream_frame_head head = { frame->clear_colour, frame->clear_depth, frame->draw_count,
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
