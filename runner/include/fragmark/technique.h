/* Techniques of the simulated tile-based GPU: the hooks of a method whose feed is `frames`.
 *
 * Such a method has the head of every other (method.h) and, in place of resources and passes, a
 * fm_technique. Everything that a tile-based GPU does anyway (binning, rasterising, depth tests,
 * blending, counting) is the device's. A technique says which parts it has beside that, and decides
 * at four points: whether a primitive is taken for hidden in a tile, where it goes in the tile's
 * list, whether it enters the tile's signature, and what happens at the start and at the end of a
 * tile. Parts that no technique asks for, or that a frame has no use for, do not run and are not
 * counted.
 *
 * Hooks are called from several threads, for different tiles at a time: they keep no state but what
 * they are handed, and allocate nothing. What they are handed lives until they return. In all
 * structs zero means "the default" or "none". Terms are those of Anglada et al., Early Visibility
 * Resolution (EVR), HPCA 2019: FVP, ZR, layers, NWOZ and WOZ primitives.
 *
 * Depths are 24-bit numbers, doubled: a depth word is 2 z, so that half a step lies between any
 * two. The clear depth is FM_DEPTH_FARTHEST unless the frame says otherwise. */
#ifndef FRAGMARK_TECHNIQUE_H
#define FRAGMARK_TECHNIQUE_H

#include <stdbool.h>
#include <stdint.h>

/* The depth word of z = 2^24 - 1. */
#define FM_DEPTH_FARTHEST (2u * 0xFFFFFFu)

enum {
    FM_TILE_SIDE = 16,                            /* pixels along a side of a tile */
    FM_TILE_PIXELS = FM_TILE_SIDE * FM_TILE_SIDE, /* pixels of a tile */
    FM_MAX_PART_CHOICES = 8,                      /* entries of fm_technique.choices */
};

/* What a technique needs of the device: any of these bits. */
enum {
    FM_PART_VISIBILITY = 1u << 0,  /* layer generator, layer buffer, ZR, FVP table */
    FM_PART_SIGNATURES = 1u << 1,  /* a CRC32 of each tile's input, of this frame and the last */
    FM_PART_TAINT = 1u << 2,       /* what unsigned primitives did: fm_tile_end.unsafe. Needs both
                                      parts above */
    FM_PART_EXACT_TIES = 1u << 3,  /* of equal depths that wins which would in submission order */
    FM_PART_PAPER_TYPES = 1u << 4, /* whatever writes depth counts as FM_TYPE_WOZ */
    FM_PART_OWNER = 1u << 5,       /* the layer buffer knows who wrote it: fm_tile_end.far_is_woz */
    FM_PART_PREPASS = 1u << 6,     /* FM_TYPE_WOZ is binned and drawn twice, first depth only. Needs
                                      submission order: no `place` */
    FM_PART_FINAL_DEPTH = 1u << 7, /* the depth buffer starts as it will end, at no cost. Needs
                                      submission order: no `place` */
    FM_PART_PREVIOUS_COLOUR = 1u << 8, /* fm_tile_end.is_equal is known */
    FM_PART_OBJECT_ORDER = 1u << 9,    /* neighbouring draw calls of FM_TYPE_WOZ are drawn front to
                                          back, by how near their objects came in the last frame */
    FM_PART_TWO_BUFFERS = 1u << 10,    /* frames are drawn in turns into two frame buffers with a
                                          memory (FVP, signatures) each: "previous" is the frame
                                          before the last */
    FM_PART_UPLOADS = 1u << 11,        /* fm_tile_start.has_uploads is known */
};
#define FM_PARTS_ALL ((1u << 12) - 1u) /* all of the above */

/* What a primitive is to visibility; its draw call decides. */
typedef enum fm_primitive_type {
    FM_TYPE_NWOZ,    /* does not write depth */
    FM_TYPE_WOZ,     /* writes depth and may be reordered: LESS or LEQUAL, no blending, all colour
                        channels, no stencil */
    FM_TYPE_BARRIER, /* writes depth in another way, and is not reordered */
    FM_TYPE_SHADER_DEPTH, /* as a barrier, and its shader computes the depth */
    FM_TYPE_COUNT         /* how many types there are; no type */
} fm_primitive_type;

/* The farthest visible point of a tile, when it was last rendered. */
typedef struct fm_fvp {
    bool is_layer;  /* value is a layer, else a depth word */
    uint32_t value; /* {false, UINT32_MAX}: not known; nothing is farther */
} fm_fvp;
#define FM_FVP_UNKNOWN ((fm_fvp){ false, UINT32_MAX }) /* nothing is known of the tile */

/* One primitive in one tile, in submission order, as lists are built. */
typedef struct fm_pair {
    fm_primitive_type type; /* of its draw call */
    bool depth_test;        /* it is depth tested */
    uint32_t layer;         /* of this tile and frame; 0 without FM_PART_VISIBILITY */
    uint32_t depth_near;    /* nearest depth word of the whole primitive */
    fm_fvp fvp;             /* of the tile */
} fm_pair;

/* What `predict` says of a pair. */
typedef enum fm_prediction {
    FM_VISIBLE,         /* or not known */
    FM_HIDDEN_BY_LAYER, /* its layer lies behind the tile's farthest visible one */
    FM_HIDDEN_BY_DEPTH, /* all of it lies behind the tile's farthest visible depth */
} fm_prediction;

/* Where `place` puts a pair: a tile has two lists. */
typedef enum fm_place {
    FM_PLACE_FIRST,   /* at the end of the first list */
    FM_PLACE_SECOND,  /* at the end of the second, which is drawn after the first */
    FM_PLACE_BARRIER, /* the second list moves to the end of the first; then as FM_PLACE_FIRST */
} fm_place;

/* A tile whose list is complete, before it is rendered. */
typedef struct fm_tile_start {
    uint32_t signature, previous; /* of this frame; of the frame before */
    bool previous_valid;          /* as the technique left it; false in the first frame */
    bool has_uploads;             /* FM_PART_UPLOADS: the frame has a texture's new contents */
    uint32_t bits;                /* the technique's own, of this frame */
} fm_tile_start;

/* What becomes of the colours of a tile that was rendered. */
typedef enum fm_tile_outcome {
    FM_TILE_FLUSHED, /* colours go to memory */
    FM_TILE_KEPT,    /* rendered, but memory already holds these colours */
    FM_TILE_FORESEEN /* only an oracle knew: the tile counts as never rendered */
} fm_tile_outcome;

/* A tile that was rendered. */
typedef struct fm_tile_end {
    uint32_t parts;     /* in force: the technique's and those of chosen options */
    uint32_t layer_far; /* least layer of any pixel */
    uint32_t depth_far; /* largest depth word of any pixel */
    uint32_t zr;        /* layer of the last depth-writing fragment that passed; UINT32_MAX: none */
    bool far_is_woz;    /* FM_PART_OWNER: a pixel of layer_far was written by a depth writer */
    bool unsafe; /* FM_PART_TAINT: an unsigned fragment passed in layer_far or nearer, or a signed
                    one might have fared otherwise without the depths that unsigned ones wrote */
    bool depth_cleared; /* within the frame: depth_far says nothing of what came before */
    bool is_equal;      /* FM_PART_PREVIOUS_COLOUR: all colours are those of the last frame */
    uint32_t bits;      /* the technique's own, as `sign` left them */
    /* What follows is filled by the hook. */
    fm_fvp fvp;              /* kept for the next frame; default: not known */
    bool signature_valid;    /* kept for the next frame; default: true */
    fm_tile_outcome outcome; /* default: flushed */
} fm_tile_end;

/* An option's value that asks for further parts. */
typedef struct fm_part_choice {
    const char *option, *value; /* of the method's options */
    uint32_t parts;             /* FM_PART_* added where the option has this value */
} fm_part_choice;

/* The parts and hooks of a technique. Each hook may be NULL. */
typedef struct fm_technique {
    uint32_t parts;                              /* FM_PART_* that it always has */
    fm_part_choice choices[FM_MAX_PART_CHOICES]; /* an entry without an option is skipped */

    /* Whether a pair is taken for hidden in its tile. NULL: FM_VISIBLE. Needs
     * FM_PART_VISIBILITY. */
    fm_prediction (*predict)(const fm_pair *pair);
    /* Where the pair goes. NULL: FM_PLACE_FIRST. FM_PLACE_SECOND is for FM_TYPE_WOZ only. */
    fm_place (*place)(const fm_pair *pair, fm_prediction prediction);
    /* Whether the pair enters the tile's signature; *bits is zero at the start of a frame. NULL: it
     * does. Needs FM_PART_SIGNATURES. */
    bool (*sign)(uint32_t *bits, const fm_pair *pair, fm_prediction prediction);
    /* Whether the tile keeps its colours of the last frame. NULL: never. Needs FM_PART_SIGNATURES;
     * never called for the first frame. A tile that is skipped keeps FVP and signature_valid. */
    bool (*skip)(const fm_tile_start *tile);
    /* Called after a tile was rendered, to fill the last three fields. NULL: their defaults. */
    void (*tile_end)(fm_tile_end *tile);
} fm_technique;

#endif
