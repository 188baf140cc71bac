/* For tests of the simulated GPU: techniques from their plugins, small random sequences. */
#ifndef FM_TBR_KIT_H
#define FM_TBR_KIT_H

#include "device/tbr/tbr.h"
#include "plugin.h"

enum { KIT_MAX_FRAMES = 8, KIT_MAX_DRAWS = 12 };

/* A technique as a test asks for it: "tbr-evr", "tbr-evr tie=exact types=paper". */
typedef struct kit_technique {
    fm_plugin *plugin;
    uint32_t parts;
} kit_technique;

kit_technique kit_technique_open(const char *words);
void kit_technique_close(kit_technique *technique);
/* threads = 1 and everything else as given. */
tbr *kit_gpu(const kit_technique *technique, uint32_t width_px, uint32_t height_px);

typedef struct kit_sequence {
    uint32_t width_px, height_px, count;
    fm_frame_builder frames[KIT_MAX_FRAMES];
} kit_sequence;

/* What random draw calls may be; zero: opaque depth writers with LESS, never two at a depth. */
enum {
    KIT_TIES = 1u << 0,   /* and LEQUAL */
    KIT_NWOZ = 1u << 1,   /* opaque and blended, with and without a depth test */
    KIT_SLOPED = 1u << 2, /* depths that vary over a primitive; triangles that are no quads */
    KIT_DISCARD = 1u << 3,
    KIT_BARRIERS = 1u << 4, /* blended and masked depth writers, other tests, stencil */
    KIT_CLEARS = 1u << 5,   /* of depth, inside a frame */
    KIT_SHADER_DEPTH = 1u << 6,
    KIT_STATIC = 1u << 7,    /* all frames alike */
    KIT_FAR_CLEAR = 1u << 8, /* the clear depth is not always the farthest */
};
#define KIT_ALL 0x17Fu

/* KIT_MAX_FRAMES frames of a few draw calls; from one to the next some go, come, move or change. */
void kit_random(kit_sequence *sequence, uint64_t seed, uint32_t flags);
void kit_sequence_free(kit_sequence *sequence);

/* A draw call of the plainest kind: opaque, no depth test; with a depth writer's state. */
fm_draw_call kit_draw(void);
fm_draw_call kit_woz(void);
/* Two triangles over [x0, x1) x [y0, y1) px at depth z, coloured by u and v. */
void kit_quad(fm_frame_builder *builder, const int32_t px[4], uint32_t z);

#endif
