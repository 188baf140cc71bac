/* Random sequences built to break techniques of the simulated tile-based GPU: a few draw calls a
 * frame, with all that may stand in the way of predictions and signatures; from one frame to the
 * next some go, come, move or change. For whether images are right: their times and energies say
 * nothing of real programs. */
#ifndef FM_GENERATORS_ADVERSARIAL_H
#define FM_GENERATORS_ADVERSARIAL_H

#include "model/settings.h"
#include "scene/frame_builder.h"

/* What draw calls may be; zero: opaque depth writers with LESS, never two at a depth. */
enum {
    ADVERSE_TIES = 1u << 0,   /* and LEQUAL */
    ADVERSE_NWOZ = 1u << 1,   /* opaque and blended, with and without a depth test */
    ADVERSE_SLOPED = 1u << 2, /* depths that vary over a primitive; triangles that are no quads */
    ADVERSE_DISCARD = 1u << 3,
    ADVERSE_BARRIERS = 1u << 4, /* blended and masked depth writers, other tests, stencil */
    ADVERSE_CLEARS = 1u << 5,   /* of depth, inside a frame */
    ADVERSE_SHADER_DEPTH = 1u << 6,
    ADVERSE_STATIC = 1u << 7,    /* all frames alike */
    ADVERSE_FAR_CLEAR = 1u << 8, /* the clear depth is not always the farthest */
};
/* But for STATIC. */
#define ADVERSE_ALL 0x17Fu

typedef struct fm_adversary_desc {
    uint64_t seed;
    uint32_t flags;               /* ADVERSE_* */
    uint32_t width_px, height_px; /* 0: 5 to 24, by the seed; at most FRAMES_SIDE_MAX */
    fm_draw_call plain;           /* what draw calls cost, and a colour mask: their common part */
} fm_adversary_desc;

/* A draw call that is there until it goes. */
typedef struct fm_adverse_thing {
    fm_draw_call draw;
    int32_t px[4];
    uint32_t z;
    bool is_sloped, is_clear;
    uint64_t shape; /* of what is sloped */
} fm_adverse_thing;

enum { FM_ADVERSARY_DRAWS = 12 };

/* Where a sequence stands; for others to read: width and height, px. */
typedef struct fm_adversary {
    fm_adversary_desc desc;
    uint64_t state;
    uint32_t next_id;
    int32_t width, height;
    fm_adverse_thing things[FM_ADVERSARY_DRAWS];
    uint32_t count;
    bool is_near; /* the clear depth */
} fm_adversary;

void adversary_start(fm_adversary *made, const fm_adversary_desc *desc);
/* The next frame, in place of what the builder holds. The same desc gives the same frames on every
 * machine. */
void adversary_frame(fm_frame_builder *builder, fm_adversary *adversary);

/* All of it, as a scene. FM_INVALID: a viewport over FRAMES_SIDE_MAX; FM_NO_MEMORY. */
fm_status adversarial_generate(fm_sequence **sequence, const fm_settings *settings, fm_error *err);

#endif
