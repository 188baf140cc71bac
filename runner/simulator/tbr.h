/* The simulated tile-based GPU: frames in, an image and counts of events out. Function only: what
 * the events cost in cycles and energy is the models' business (cycles.h, energy.h), which are
 * handed what they need and change nothing.
 *
 * A frame has two phases. Geometry, in submission order: triangles are set up, assigned to the
 * tiles that they overlap, numbered by layer, predicted, put into the tile's lists and signed
 * (bin.c). Raster, tile by tile and in parallel: a tile is skipped or its lists are drawn into
 * on-chip buffers and flushed (tile.c, span.c). The same sequence gives the same image and the same
 * counts with any number of threads. */
#ifndef FM_TBR_H
#define FM_TBR_H

#include <stdbool.h>
#include <stdint.h>

#include "counters.h"
#include "fragmark/technique.h"
#include "scene/frames.h"

typedef struct tbr tbr;

/* What one entry of a rendered tile's list cost. */
typedef struct tbr_work {
    uint32_t draw; /* of the frame */
    uint8_t quads, shaded_quads;
    bool is_prepass; /* depth only */
} tbr_work;

/* A tile that was rendered, as a cycle model sees it. */
typedef struct tbr_tile_work {
    uint32_t tile;
    const fm_frame *frame;
    const tbr_work *work; /* [count], in the order drawn; depth clears are not there */
    uint32_t count;
    uint32_t flush_bytes;
    bool scans; /* depth and layers are read at the end */
} tbr_tile_work;

/* The geometry phase, for a cycle model. */
typedef struct tbr_geometry {
    const fm_frame *frame;
    uint32_t primitive_count;
    const uint32_t *pair_counts;    /* [primitive_count] */
    const uint32_t *primitive_draw; /* [primitive_count] */
    const bool *draw_is_prepassed;  /* [draws]: its primitives are binned and drawn twice */
    const uint8_t *pair_is_signed;  /* [pairs], in order; NULL without signatures */
} tbr_geometry;

typedef struct tbr_desc {
    uint32_t width_px, height_px;
    const fm_technique *technique; /* NULL: nothing but the GPU. Borrowed */
    uint32_t parts;                /* FM_PART_*: the technique's, with those of chosen options */
    uint32_t threads;              /* 0: one a processor, 16 at most */
    bool keep_layers;              /* layer bookkeeping also where no primitive needs it: tests */
    bool no_vectors;               /* the portable build of the inner loop: tests */
    /* What models hear; NULL: nobody. Once after the geometry phase, with its counts ... */
    void (*binned)(void *context, const tbr_geometry *geometry, const tbr_counters *counters);
    /* ... and, from the threads, once for each rendered tile; those of a row in order, by one. */
    void (*rendered)(void *context, const tbr_tile_work *work);
    void *context;
} tbr_desc;

/* FM_INVALID: a side of 0 px or over FRAMES_SIDE_MAX; FM_NO_MEMORY. */
fm_status tbr_create(tbr **made, const tbr_desc *desc, fm_error *err);
void tbr_destroy(tbr *gpu);
/* One frame; it must have passed frame_check. FM_NO_MEMORY. */
fm_status tbr_frame(tbr *gpu, const fm_frame *frame, fm_error *err);

/* ---- of the last frame ---- */

/* RGBA8, row 0 at the top. */
const uint32_t *tbr_image(const tbr *gpu);
const tbr_counters *tbr_counts(const tbr *gpu);
uint32_t tbr_tile_count(const tbr *gpu);
uint32_t tbr_tiles_across(const tbr *gpu);
uint32_t tbr_thread_count(const tbr *gpu);

typedef struct tbr_tile_info {
    bool is_skipped;
    bool signature_valid; /* after the frame */
    uint32_t signature;   /* of the frame */
    fm_fvp fvp;           /* after the frame */
} tbr_tile_info;
tbr_tile_info tbr_tile(const tbr *gpu, uint32_t tile);

/* One entry of a tile's list, as it is drawn. */
typedef struct tbr_list_entry {
    uint32_t primitive; /* counted over draw calls in submission order; UINT32_MAX: depth clear */
    uint32_t draw;
    uint32_t layer;
    fm_prediction prediction;
    bool is_signed;
} tbr_list_entry;
/* Fills at most `room` entries; returns how many there are. */
uint32_t tbr_list(const tbr *gpu, uint32_t tile, tbr_list_entry *entries, uint32_t room);

/* The type of a draw call's primitives. */
fm_primitive_type tbr_type(const fm_draw_call *draw, uint32_t parts);

#endif
