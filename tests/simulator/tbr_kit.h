/* For tests of the simulated GPU: techniques from their plugins, small random sequences. */
#ifndef FM_TBR_KIT_H
#define FM_TBR_KIT_H

#include "generators/adversarial.h"
#include "plugin/plugin.h"
#include "scene/frame_builder.h"
#include "simulator/tbr.h"

enum { KIT_MAX_FRAMES = 8 };

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

/* KIT_MAX_FRAMES frames of an adversary with these flags. */
void kit_random(kit_sequence *sequence, uint64_t seed, uint32_t flags);
void kit_sequence_free(kit_sequence *sequence);

/* A draw call of the plainest kind: opaque, no depth test; with a depth writer's state. */
fm_draw_call kit_draw(void);
fm_draw_call kit_woz(void);

#endif
