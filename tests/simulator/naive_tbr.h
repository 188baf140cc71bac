/* The simulated GPU once more: slow, obvious, written from the rules (runner/scene/frames.h,
 * fragmark/technique.h and the papers) and not from the device. It goes pixel by pixel where the
 * device goes primitive by primitive, keeps whole lists where the device chains, and compares what
 * was signed byte by byte where the device has a CRC. */
#ifndef FM_NAIVE_TBR_H
#define FM_NAIVE_TBR_H

#include "fragmark/technique.h"
#include "scene/frames.h"

enum { NAIVE_MAX_ENTRIES = 64, NAIVE_MAX_TILES = 16, NAIVE_MAX_SIGNED = 8192 };

/* Which technique: zero is the baseline. */
typedef struct naive_rules {
    bool predicts;   /* EVR's prediction */
    bool reorders;   /* Algorithm 1 */
    bool eliminates; /* RE: tiles of equal input are skipped */
    bool leaves_out; /* what is predicted hidden is not signed */
    bool is_safe;    /* signatures that do not tell all are not used */
    bool exact_ties;
    bool owner; /* the FVP is a depth where a depth writer owns a farthest pixel */
} naive_rules;

typedef struct naive_entry {
    uint32_t primitive, draw, layer;
    fm_prediction prediction;
    bool is_signed, is_clear;
    const fm_triangle *triangle;
} naive_entry;

typedef struct naive_tile {
    naive_entry list[NAIVE_MAX_ENTRIES]; /* as drawn */
    uint32_t count;
    bool is_skipped;
    fm_fvp fvp;
    bool is_valid;
    unsigned char signed_bytes[NAIVE_MAX_SIGNED];
    uint32_t signed_count;
} naive_tile;

typedef struct naive_gpu {
    naive_rules rules;
    int32_t width, height, tiles_x, tiles_y;
    uint32_t frame_count;
    naive_tile tiles[NAIVE_MAX_TILES];
    uint32_t *image;
} naive_gpu;

naive_gpu *naive_create(const naive_rules *rules, uint32_t width_px, uint32_t height_px);
void naive_destroy(naive_gpu *gpu);
void naive_frame(naive_gpu *gpu, const fm_frame *frame);

#endif
