/* What the files of the simulator share. */
#ifndef FM_TBR_INTERNAL_H
#define FM_TBR_INTERNAL_H

#include <stdatomic.h>

#include "crc.h"
#include "history.h"
#include "pool.h"
#include "setup.h"
#include "span.h"
#include "tbr.h"

enum {
    TBR_MAX_THREADS = 16,
    TBR_MAX_LAYER = 2047,  /* 11 bits */
    TBR_COMMAND_BITS = 12, /* the last value means "none" */
    TBR_STATE_BYTES = 40,  /* of a draw call, signed */
    TBR_POINTER_BYTES = 4, /* of a list's entry */
    TBR_LAYER_BYTES = 2,   /* beside it */
    TBR_LINE_BYTES = 64,
};
#define TBR_NO_ENTRY UINT32_MAX
#define TBR_CLEAR    UINT32_MAX /* as a primitive: a depth clear */
#define TBR_NO_ZR    UINT32_MAX

/* A draw call, made ready once a frame. */
typedef struct tbr_draw {
    fm_primitive_type type;
    bool tests_depth, writes_depth;
    bool delimits; /* the final depth of what comes before says nothing about what comes after */
    uint32_t digest;
    uint32_t state_crc;
    uint32_t submitted_first, binned_first; /* its first primitive, in either order */
} tbr_draw;

/* A node of a tile's list. */
typedef struct tbr_entry {
    uint32_t primitive; /* or TBR_CLEAR */
    uint32_t draw;
    uint32_t next;
    uint16_t layer;
    uint8_t prediction;
    bool is_signed;
} tbr_entry;

typedef struct tbr_chain {
    uint32_t head, tail; /* TBR_NO_ENTRY: empty */
} tbr_chain;

/* A tile in the geometry phase; reset each frame. */
typedef struct tbr_bin {
    tbr_chain first, second;
    uint32_t signature;
    uint32_t signed_draw; /* whose state was signed last; TBR_NO_ENTRY: none */
    uint32_t bits;        /* the technique's */
    uint16_t command;     /* layer generator table */
    uint16_t layer;
    bool last_is_woz;
    bool is_skipped;
} tbr_bin;

/* A tile across frames. */
typedef struct tbr_memory {
    fm_fvp fvp;
    uint32_t signature;
    bool signature_valid;
} tbr_memory;

struct tbr {
    tbr_desc desc;
    fm_technique technique; /* hooks; all NULL without one */
    tbr_span_function *span;
    uint32_t tiles_x, tiles_y, tile_count;
    uint32_t frame_index; /* frames done */
    crc_table crc;
    crc_shift shift_state, shift_primitive;

    uint32_t *image, *other_image;     /* [height][width]; other: with FM_PART_TWO_BUFFERS */
    tbr_bin *bins;                     /* [tile_count] */
    tbr_memory *memory, *other_memory; /* [tile_count] */
    history *history;                  /* NULL: no part needs it */
    bool has_uploads;

    const fm_frame *frame;
    bool tracks_layers; /* in this frame */
    tbr_draw *draws;
    bool *draw_is_prepassed;
    bool *draw_may_move;  /* with FM_PART_OBJECT_ORDER: */
    uint32_t *draw_order; /* submitted numbers, as binned */
    uint32_t draw_room;
    tbr_setup *setups; /* [primitive_count], in the order binned */
    uint32_t *primitive_draw, *pair_counts;
    uint32_t primitive_count, primitive_room;
    tbr_entry *entries;
    uint8_t *pair_is_signed;
    uint64_t pair_count; /* entries that are primitives */
    uint32_t entry_count, entry_room;

    tbr_counters counters;
    pool *pool;
    struct tbr_thread *threads; /* [desc.threads] */
    atomic_uint next_row;       /* of tiles */
};

/* A raster thread's own. */
typedef struct tbr_thread {
    tbr_buffers buffers;
    tbr_counters counters;
    tbr_work *work;
    uint32_t work_room;
    bool failed;         /* no memory for work */
    bool is_wrong;       /* `tile_end` filled what it must not: */
    uint32_t wrong_tile; /* in this tile first, */
    unsigned wrong_value;
    const char *wrong_field;
} tbr_thread;

/* Whether there is a frame that "previous" means. */
static inline bool tbr_has_previous(const tbr *gpu)
{
    return gpu->frame_index >= ((gpu->desc.parts & FM_PART_TWO_BUFFERS) != 0 ? 2u : 1u);
}

/* The geometry phase of gpu->frame. */
fm_status bin_frame(tbr *gpu, fm_error *err);
/* Skips or renders one tile. */
void tile_run(tbr *gpu, tbr_thread *thread, uint32_t tile);

static inline bool tbr_has(const tbr *gpu, uint32_t part)
{
    return (gpu->desc.parts & part) != 0;
}

#endif
