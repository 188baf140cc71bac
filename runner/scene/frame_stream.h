/* Sequences of frames in a file, NAME.stream: what `fragmark record` writes and generator `stream`
 * replays.
 *
 * 32-bit words, little-endian. Head: STREAM_MAGIC, version, width_px, height_px, frame count. Then
 * of each frame: clear colour, clear depth, draw calls, triangles (counts), its fm_draw_calls and
 * its fm_triangles as they lie (frames.h).
 *
 * A recorder cannot know what shaders cost. texture_bytes16 of a recorded draw call is 16 for each
 * texture that it reads; vertex_instructions and fragment_instructions are 0. Replay puts in what
 * the scene says: the keys of these names, and `texture_bytes` for each texture. */
#ifndef FM_FRAME_STREAM_H
#define FM_FRAME_STREAM_H

#include <stdio.h>

#include "frames.h"

enum { STREAM_VERSION = 1, STREAM_MAGIC_BYTES = 8 };
#define STREAM_MAGIC ((const char[STREAM_MAGIC_BYTES]){ 'f', 'm', 's', 't', 'r', 'e', 'a', 'm' })

typedef struct fm_stream_head {
    char magic[STREAM_MAGIC_BYTES];
    uint32_t version, width_px, height_px, frame_count;
} fm_stream_head;

/* Before the draw calls and triangles of each frame. */
typedef struct fm_stream_frame_head {
    uint32_t clear_colour, clear_depth, draw_count, triangle_count;
} fm_stream_frame_head;
_Static_assert(sizeof(fm_stream_head) == 24 && sizeof(fm_stream_frame_head) == 16,
               "stored as they lie");
_Static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__, "streams are stored as they lie");

/* Starts as {0}. The file has its name only once it is closed: before, it is PATH.partial. */
typedef struct fm_stream_writer {
    FILE *file;
    char *path;
    fm_stream_head head;
} fm_stream_writer;

fm_status stream_writer_open(fm_stream_writer *writer, const char *path, uint32_t width_px,
                             uint32_t height_px, fm_error *err);
fm_status stream_writer_add(fm_stream_writer *writer, const fm_frame *frame, fm_error *err);
/* Without frames nothing is left. Closed writers may be closed again. */
fm_status stream_writer_close(fm_stream_writer *writer, fm_error *err);

/* The costs that a replay puts in. */
typedef struct fm_stream_costs {
    uint16_t vertex_instructions, fragment_instructions;
    double texture_bytes; /* for each texture and shaded fragment */
} fm_stream_costs;

/* The first frame_count frames of a file. FM_IO: it cannot be read; FM_INVALID: it is no stream, is
 * cut off, or holds fewer frames. Frames must still pass frame_check. */
fm_status stream_open(fm_sequence **sequence, const char *path, uint32_t frame_count,
                      const fm_stream_costs *costs, fm_error *err);

#endif
