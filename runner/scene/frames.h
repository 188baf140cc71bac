/* Sequences of frames for the simulated tile-based GPU: what a geometry pipeline hands to binning,
 * and the rules by which it becomes pixels.
 *
 * Units. Positions are sixteenths of a pixel, y down; pixel (x, y) has its centre at
 * (16 x + 8, 16 y + 8). Depths are 24-bit numbers, 0 nearest. u and v are 32-bit numbers that wrap,
 * 65 536 to a texel. Colours are RGBA8, red in the low byte, not premultiplied.
 *
 * Coverage. A triangle whose doubled area (x1-x0)(y2-y0) - (x2-x0)(y1-y0) is zero has no pixels;
 * with a negative one its corners 1 and 2 are exchanged. A pixel is covered if for each edge from a
 * to b E = (bx-ax)(cy-ay) - (by-ay)(cx-ax) at its centre c is positive, or zero where by < ay, or
 * by = ay and bx > ax.
 *
 * Interpolation of z (with f = 7 bits of fraction), u and v (f = 0), the same in all tiles:
 *     gx = ((a1-a0)(y2-y0) - (a2-a0)(y1-y0)) 16 2^f / area, cut towards zero, kept within +-2^40
 *     gy = ((a2-a0)(x1-x0) - (a1-a0)(x2-x0)) 16 2^f / area, likewise
 *     a(x, y) = a0 2^f + floor((gx (8 - x0) + gy (8 - y0)) / 16) + gx x + gy y     modulo 2^32
 * where z is then read as signed, divided by 2^7 rounding down and kept within the depths of the
 * three corners. Differences of u and v are signed, modulo 2^32.
 *
 * Colour. h = (u >> 16) 0x9E3779B1 + (v >> 16) 0x85EBCA77 + digest; h ^= h >> 15; h *= 0x2C1B3C6D;
 * h ^= h >> 12; the digest is draw_digest(). The low 24 bits are red, green and blue. Alpha is the
 * draw call's, but 255 where it is textured and bit 31 of h is set. A discarding draw call drops
 * the fragments with bits 28 and 29 of h zero. One that computes its depth adds (h & 0xFFFF) to z,
 * at most 0xFFFFFF.
 *
 * Blending, per channel, with d the colour that is there, a the alpha, div(t) the nearest integer
 * to t / 255: over: div(s a + d (255 - a)); add: min(255, d + div(s a)); alpha itself as a channel
 * with s = 255 (over) or s = a, a = 255 (add). A fragment is opaque if all channels are written and
 * it is not blended, or blended over with alpha 255. Channels that the mask leaves out stay.
 *
 * Tiles. The pixels whose centres lie in a triangle's box (borders included) and on the screen make
 * its pixel box. The triangle overlaps the tiles that the pixel box touches, without those where
 * for one edge none of the tile's 256 pixel centres (on the screen or not) is inside: E is positive
 * there, or zero where coverage takes zero. So a triangle overlaps every tile that it has a pixel
 * in, and no tile of which an edge only meets centres that count as outside. */
#ifndef FM_FRAMES_H
#define FM_FRAMES_H

#include <stdbool.h>
#include <stdint.h>

#include "base/error.h"
#include "fragmark/method.h"

enum {
    FRAMES_SUBPIXELS = 16,
    FRAMES_COORDINATE_MAX = 1 << 17, /* positions lie within it, either sign */
    FRAMES_DEPTH_MAX = 0xFFFFFF,
    FRAMES_SIDE_MAX = 4096, /* px */
};

typedef struct fm_corner {
    int32_t x, y; /* FRAMES_COORDINATE_MAX at most */
    uint32_t z;   /* FRAMES_DEPTH_MAX at most */
    uint32_t u, v;
} fm_corner;

typedef struct fm_triangle {
    fm_corner corners[3];
} fm_triangle;
_Static_assert(sizeof(fm_triangle) == 60, "signed and stored as it lies");

typedef enum fm_mix {
    FM_MIX_OFF,
    FM_MIX_OVER,
    FM_MIX_ADD,
    FM_MIX_COUNT,
} fm_mix;

enum {
    FM_DRAW_DEPTH_CLEAR = 1u << 0, /* no triangles: all depths become clear_depth */
    FM_DRAW_DEPTH_WRITE = 1u << 1,
    FM_DRAW_DISCARD = 1u << 2,
    FM_DRAW_SHADER_DEPTH = 1u << 3,
    FM_DRAW_STENCIL = 1u << 4, /* kept apart from reordering; the stencil itself is not simulated */
    FM_DRAW_TEXTURED_ALPHA = 1u << 5,
};
#define FM_DRAW_FLAGS_ALL ((1u << 6) - 1u)

/* A draw call: state, costs, and its triangles. */
typedef struct fm_draw_call {
    uint32_t flags;        /* FM_DRAW_* */
    fm_compare depth_test; /* FM_COMPARE_OFF: no test, and no write */
    fm_mix mix;
    uint8_t mask;    /* channels written: bit 0 red ... bit 3 alpha */
    uint8_t alpha;   /* 255: opaque */
    uint16_t object; /* the same thing in all frames: what is ordered by object */
    uint32_t shader, uniforms, texture, texture_version;
    uint32_t clear_depth;
    uint32_t vertices; /* shaded, once each */
    uint16_t vertex_instructions, fragment_instructions;
    uint16_t attribute_bytes; /* of a primitive after transformation, for the parameter buffer */
    uint16_t scalars;         /* interpolated for each fragment */
    uint16_t texture_bytes16; /* DRAM bytes of texture for a shaded fragment, in sixteenths */
    uint16_t vertex_bytes;    /* fetched for a vertex */
    uint32_t first, count;    /* triangles */
} fm_draw_call;
_Static_assert(sizeof(fm_draw_call) == 60, "stored as it lies, without holes");

typedef struct fm_frame {
    uint32_t clear_colour, clear_depth;
    fm_draw_call *draws;
    uint32_t draw_count;
    fm_triangle *triangles;
    uint32_t triangle_count;
} fm_frame;

/* A sequence: frames by number, each valid until the next is asked for. */
typedef struct fm_sequence {
    uint32_t width_px, height_px, frame_count;
    fm_status (*frame)(struct fm_sequence *sequence, const fm_frame **frame, uint32_t index,
                       fm_error *err);
    void (*destroy)(struct fm_sequence *sequence); /* may be NULL */
} fm_sequence;

void sequence_destroy(fm_sequence *sequence);

/* What a draw call adds to the colour of all its fragments. */
uint32_t draw_digest(const fm_draw_call *draw);

/* FM_INVALID: positions, depths, states or ranges of triangles that the rules above do not know,
 * naming frame, draw call and field. */
fm_status frame_check(const fm_frame *frame, uint32_t index, fm_error *err);

#endif
