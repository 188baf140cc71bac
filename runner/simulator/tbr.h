/* The simulated tile-based GPU: frames in, an image and counts of events out.
 *
 * A frame has two phases. Geometry runs in submission order: triangles are set up, assigned to the
 * tiles that they overlap, numbered by layer, predicted, put into the tiles' lists and signed.
 * Raster runs tile by tile and in parallel: a tile is skipped, or its lists are drawn into on-chip
 * buffers and flushed. The same sequence gives the same image and the same counts with any number
 * of threads. What frames are made of, and the rules of coverage, depth and blending, are in
 * scene/frames.h; what a technique may decide is in fragmark/technique.h.
 *
 * What lives in this room:
 *   tbr.c              a simulator's life, and its frames; internal.h is what the next share
 *   bin.c              the geometry phase: setup.c triangles, crc.c signatures, history.c what the
 *                      frame before says of objects and textures
 *   tile.c             the raster phase of one tile; span.c its inner loop, pool.c the threads
 *   counters.c         the events that are counted
 *   models/            cycles and energy, computed from events and from what `binned` and
 *                      `rendered` hand over; the simulator does not know of them
 *   technique.c        the parts that a method's technique asks for
 *   sequence_device.c  the entry `tbr` of the list of devices
 * What may not: drivers, passes and shaders (device/); how sequences are made (generators/) or
 * what an image is compared with (worker/); clocks, since simulated time is cycles, never
 * milliseconds; any method by its name: a technique arrives as a table of functions. */
#ifndef FM_TBR_H
#define FM_TBR_H

#include <stdbool.h>
#include <stdint.h>

#include "counters.h"
#include "fragmark/technique.h"
#include "plugin/hook_mark.h"
#include "scene/frames.h"

/* A simulator. It is used by one thread, whatever threads it works with itself. Tiles are numbered
 * row by row from the upper left, tbr_tiles_across() in a row; each is FM_TILE_SIDE px wide and
 * high, at the right and lower border perhaps only partly on the screen. */
typedef struct tbr tbr;

/* What one entry of a rendered tile's list cost. */
typedef struct tbr_work {
    uint32_t draw;        /* index of its draw call in the frame */
    uint8_t quads;        /* 2x2 pixels rasterised, 0 to 64 */
    uint8_t shaded_quads; /* of those, with a fragment that was shaded; 0 in a prepass */
    bool is_prepass;      /* it was drawn for its depth alone (FM_PART_PREPASS) */
} tbr_work;

/* A tile that was rendered, as a cycle model sees it. Pointers are valid during the call. */
typedef struct tbr_tile_work {
    uint32_t tile;         /* its number */
    const fm_frame *frame; /* that `draw` of its work is an index into */
    const tbr_work *work;  /* [count], in the order drawn; depth clears are not there */
    uint32_t count;        /* of entries drawn, a prepassed one twice */
    uint32_t flush_bytes;  /* colours written to memory; 0: the tile was kept */
    bool scans;            /* depth and layers are read at the tile's end (FM_PART_VISIBILITY) */
} tbr_tile_work;

/* The geometry phase, as a cycle model sees it. Pointers are valid during the call. */
typedef struct tbr_geometry {
    const fm_frame *frame;
    uint32_t primitive_count;       /* triangles, in the order binned */
    const uint32_t *pair_counts;    /* [primitive_count]: tiles that the primitive overlaps */
    const uint32_t *primitive_draw; /* [primitive_count]: index of its draw call */
    const bool *draw_is_prepassed;  /* [draw calls]: its primitives are binned and drawn twice */
    const uint8_t *pair_is_signed;  /* [sum of pair_counts], primitive by primitive; NULL: the
                                       technique has no signatures */
} tbr_geometry;

/* What a simulator is made of. Zero is the default but for the size. What it points at is borrowed
 * and must outlive the simulator. */
typedef struct tbr_desc {
    uint32_t width_px, height_px;  /* of the screen, 1 to FRAMES_SIDE_MAX */
    const fm_technique *technique; /* NULL: the GPU alone, which renders every tile */
    fm_hook_mark *mark;            /* told where its hooks are called; NULL: nobody asks */
    uint32_t parts;                /* FM_PART_*: the technique's, with those of chosen options, as
                                      technique_parts() tells them */
    uint32_t threads;              /* of the raster phase; 0: one a processor; 16 at most */
    bool keep_layers;              /* for tests: layers are numbered in every frame, also where all
                                      primitives write depth and none is needed */
    bool no_vectors;               /* for tests: the portable build of the inner loop */
    /* What models hear; NULL: nobody listens. Called by the thread that calls tbr_frame, once after
     * the geometry phase, with its counts ... */
    void (*binned)(void *context, const tbr_geometry *geometry, const tbr_counters *counters);
    /* ... and by the threads of the raster phase, once for each rendered tile: those of a row from
     * left to right by one thread, different rows at the same time. */
    void (*rendered)(void *context, const tbr_tile_work *work);
    void *context; /* handed to both */
} tbr_desc;

/* Makes a simulator, which the caller destroys; its first frame has no previous one.
 * FM_INVALID: a side of 0 px or over FRAMES_SIDE_MAX; FM_NO_MEMORY: also for threads that cannot be
 * started. On failure *made is NULL. */
fm_status tbr_create(tbr **made, const tbr_desc *desc, fm_error *err);
/* Accepts NULL. */
void tbr_destroy(tbr *gpu);
/* Simulates one frame, which must have passed frame_check and is borrowed for the call.
 * FM_NO_MEMORY, or FM_INVALID where a hook of the technique answers what cannot be: and from then
 * on the simulator may only be destroyed. */
fm_status tbr_frame(tbr *gpu, const fm_frame *frame, fm_error *err);

/* What follows asks about the last frame. Pointers are valid until the next one. */

/* [height][width], RGBA8 with red in the low byte, row 0 at the top. */
const uint32_t *tbr_image(const tbr *gpu);
/* Events of this frame, all tiles together. */
const tbr_counters *tbr_counts(const tbr *gpu);
/* All tiles of the screen; those of one row; threads that work. The same for all frames. */
uint32_t tbr_tile_count(const tbr *gpu);
uint32_t tbr_tiles_across(const tbr *gpu);
uint32_t tbr_thread_count(const tbr *gpu);

/* What became of a tile. */
typedef struct tbr_tile_info {
    bool is_skipped;      /* it kept its colours of before, without being rendered */
    bool signature_valid; /* after the frame: the next one may be compared with it */
    uint32_t signature;   /* CRC32 of the frame's input; 0 without FM_PART_SIGNATURES */
    fm_fvp fvp;           /* after the frame: its farthest visible point */
} tbr_tile_info;
/* tile: below tbr_tile_count. */
tbr_tile_info tbr_tile(const tbr *gpu, uint32_t tile);

/* One entry of a tile's list. */
typedef struct tbr_list_entry {
    uint32_t primitive;       /* triangles counted in the order binned, from 0; UINT32_MAX: a depth
                                 clear */
    uint32_t draw;            /* index of its draw call in the frame */
    uint32_t layer;           /* in this tile; 0 without FM_PART_VISIBILITY */
    fm_prediction prediction; /* FM_VISIBLE where nothing predicts */
    bool is_signed;           /* it entered the signature, or would have if there were one */
} tbr_list_entry;
/* Fills at most `room` entries, in the order in which they are drawn if the tile is rendered.
 * Returns how many there are, which may be more. */
uint32_t tbr_list(const tbr *gpu, uint32_t tile, tbr_list_entry *entries, uint32_t room);

/* The type of a draw call's primitives. parts: FM_PART_*, of which FM_PART_PAPER_TYPES matters. */
fm_primitive_type tbr_type(const fm_draw_call *draw, uint32_t parts);

#endif
