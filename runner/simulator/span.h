/* The inner loop: one triangle in one tile, a row of 16 pixels at a time. Built twice from one
 * source, for any processor and for one with AVX2. */
#ifndef FM_TBR_SPAN_H
#define FM_TBR_SPAN_H

#include <stdbool.h>
#include <stdint.h>

#include "fragmark/technique.h"
#include "scene/frames.h"

/* On-chip memory of a tile; [y * FM_TILE_SIDE + x]. */
typedef struct tbr_buffers {
    uint32_t colour[FM_TILE_PIXELS];
    uint32_t depth[FM_TILE_PIXELS]; /* depth words */
    uint32_t layer[FM_TILE_PIXELS];
    uint32_t owner[FM_TILE_PIXELS];     /* FM_PART_EXACT_TIES: order * 2 + (test is LEQUAL) */
    int32_t is_tainted[FM_TILE_PIXELS]; /* -1: depth written by an unsigned primitive */
    int32_t is_woz[FM_TILE_PIXELS];     /* FM_PART_OWNER: -1: layer written by a depth writer */
} tbr_buffers;

typedef enum tbr_span_mode {
    SPAN_DRAW,
    SPAN_DEPTH, /* only: lowers depths to half a step behind its own (see tile.c) */
} tbr_span_mode;

typedef struct tbr_span {
    tbr_span_mode mode;
    struct {
        int32_t e, a, b; /* at the tile's first pixel; steps right and down */
    } edges[3];
    struct {
        uint32_t base, gx, gy;
    } z, u, v;      /* likewise */
    int32_t y0, y1; /* rows of the tile */
    int32_t width;  /* pixels of a row on the screen */
    int32_t z_min, z_max;
    const fm_draw_call *draw;
    uint32_t digest;
    bool writes_depth; /* tests and writes */
    bool late_test;    /* after shading: discards, or computes its depth */
    bool tracks_layers, tracks_owner, tracks_taint, tracks_order;
    bool exact_ties; /* of its own test; needs tracks_order */
    bool is_signed;
    uint32_t layer;
    uint32_t order; /* of submission, from 1 */
} tbr_span;

/* Bit x of [y]: pixel (x, y) of the tile. */
typedef struct tbr_span_result {
    uint16_t covered[FM_TILE_SIDE];
    uint16_t shaded[FM_TILE_SIDE];
    uint16_t passed[FM_TILE_SIDE]; /* all tests */
    uint16_t failed_tainted; /* any bit: a signed fragment met a tainted depth, as tile.c says */
} tbr_span_result;

typedef void tbr_span_function(tbr_buffers *buffers, tbr_span_result *result, const tbr_span *span);
tbr_span_function span_draw_portable, span_draw_avx2;
/* The fastest that this processor has. */
tbr_span_function *span_function(bool no_vectors);

#endif
