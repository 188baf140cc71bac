/* A method on a device, set up for one scene, feed and set of options: its resources, its
 * pipelines, and the frames that it runs. The timed build composites; the checked build
 * (is_capture) counts events and writes the emitted fragments of a band of pixels down.
 *
 * The room instance turns descriptors into resources, pipelines, barriers and frames. It reads no
 * truth, judges nothing and knows no method by name. */
#ifndef FM_INSTANCE_H
#define FM_INSTANCE_H

#include "model/auto_option.h"
#include "plugin/hook_mark.h"
#include "stage/stage.h"

typedef struct fm_instance fm_instance;

typedef struct fm_instance_desc {
    fm_stage *stage;
    const fm_method_desc *method;
    fm_shader_folders folders;
    const fm_settings *settings; /* k, lock, pool, full_screen, timers, accumulate, composite */
    const fm_choice *choices;    /* see instance_choices */
    size_t choice_count;
    uint64_t fragments, fragments_kept; /* F and F_k of the scene, for formulas */
    bool is_capture;
    uint32_t capture_slots; /* fragments a pixel that the checked build has room for */
    bool counts_accesses;   /* shaders count what they do with the method's memory, which takes
                               time: for builds that are not timed */
    bool hashes_image;      /* instance_image_hash will be called */
    bool wants_primitive;   /* shaders see fm_primitive, the number of the triangle */
    fm_hook_mark *mark;     /* told where the method's hook is called; NULL: nobody asks */
} fm_instance_desc;

/* Pixels whose fragments a checked frame writes down. */
typedef struct fm_band {
    uint32_t first, pixels;
} fm_band;

typedef struct fm_frame_result {
    uint64_t pass_ns[FM_MAX_PASSES]; /* in the descriptor's order, all iterations together */
    uint64_t span_ns;                /* timers=frame: of all passes, and 0 in pass_ns */
    uint64_t canary_ns;              /* an empty interval at the frame's start */
    uint64_t wall_ns;                /* host: with read-backs, allocation and what was done again */
    uint64_t lost;                   /* fragments */
    uint64_t culled, locked;         /* checked build only: by the method's own test; locks taken */
    uint64_t arrived; /* checked build only: fragments that pass `store` got to see when it first
                         ran in the frame; what an occupancy map culled is not among them */
    uint64_t repaired, unrepaired; /* checked build only: pixels whose damage the method found */
    uint32_t cut; /* passes (bit i: number i) in which the device ended loops: what they were to do
                     is not done */
    uint32_t scene_passes; /* over the scene in the last try */
    uint32_t redos;        /* frames done again because something had to grow */
    uint64_t redone_ns;    /* of all passes of those frames; in no pass_ns, nor in span_ns */
} fm_frame_result;

/* What passes do with one of the method's resources in a frame. Attachments of draws and the
 * runner's own resources are not in it. */
typedef struct fm_accesses {
    uint64_t loaded,
        stored;       /* bytes, by shaders; fills and clears of clear passes are stored, too */
    uint64_t atomics; /* whose bytes are loaded and stored */
    uint64_t outside; /* accesses of elements that the resource does not have */
} fm_accesses;

/* Of all passes together: their sum, or the span. */
uint64_t frame_passes_ns(const fm_frame_result *result);

/* All options of the method with their values: what is missing is at its default, and `auto` is
 * worked out for the stage's device. Returns their number. What is done to the method before
 * instance_create has to know them. Of the descriptor stage, method, settings and choices count. */
size_t instance_choices(fm_choice all[FM_MAX_OPTIONS], const fm_instance_desc *desc);

/* FM_UNSUPPORTED: the device lacks something, with the reason; FM_SHADER: with plugin and pass. */
fm_status instance_create(fm_instance **instance, const fm_instance_desc *desc, fm_error *err);
void instance_destroy(fm_instance *instance);

/* One whole frame. band may be NULL. */
fm_status instance_frame(fm_frame_result *result, fm_instance *instance, const fm_band *band,
                         fm_error *err);
/* A hash of the image that the last frame drew, computed on the device: equal for equal pixels. Not
 * of a checked build, which draws none. */
fm_status instance_image_hash(uint64_t *hash, fm_instance *instance, fm_error *err);
/* The emitting passes again, for another band; only if instance_can_emit_again. */
fm_status instance_emit(fm_instance *instance, const fm_band *band, fm_error *err);
bool instance_can_emit_again(const fm_instance *instance);
/* On a software rasteriser a spin lock's owner may lose its processor for longer than all tries
 * that the waiting one's loops allow: then a frame loses fragments that the next one keeps. */
bool instance_may_give_up(const fm_instance *instance);

/* FM_UNSUPPORTED, with pass and numbers: this frame is not to be believed, because the device ended
 * loops of it. instance_frame answers so itself, unless only exclusive passes are concerned, where
 * the next frame may wait less for its locks. */
fm_status instance_cut(const fm_instance *instance, uint32_t cut, fm_error *err);

/* Fragments that reach the method, for its formulas: fewer than the scene has, if some are culled
 * before. */
void instance_tell_fragments(fm_instance *instance, uint64_t fragments);
/* Bytes as the descriptor's formula says, after a frame has sized everything. */
uint64_t instance_bytes_predicted(const fm_instance *instance);
/* Bytes of elements that hold something in a frame that keeps F_k fragments. */
uint64_t instance_bytes_used(const fm_instance *instance, uint64_t fragments_kept);
/* The k of the last frame, where the method chooses it; 0: it does not. */
uint64_t instance_k_chosen(const fm_instance *instance);
/* Of the last frame of a build that counts: what was done with resource `index`, or with the spin
 * locks where that is the number of resources. *name lives as long as the instance. false: there is
 * no such resource, or nothing was counted. */
bool instance_accesses(fm_accesses *accesses, const char **name, const fm_instance *instance,
                       size_t index);
/* Why a build that was to count does not, although its device can; "": no such reason. */
const char *instance_uncounted(const fm_instance *instance);
/* The resource of this name; its buffer may be read between frames. NULL: none. */
fm_slot *instance_slot(fm_instance *instance, const char *name);

#endif
