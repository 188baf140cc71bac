/* What the files behind instance.h share; nobody else includes it. From below:
 *   pass_facts.c           what is true of a pass on this device
 *   pass_uses.c            the resources that a pass uses, and their bindings
 *   pass_define.c          its #defines
 *   instance_source.c      its GLSL
 *   instance_passes.c      its pipelines
 *   instance_resources.c   buffers, images, locks and the table of lengths
 *   instance_bytes.c       how many bytes they are
 *   instance_counts.c      what shaders do with them, counted
 *   instance_draw.c        one pass of a frame that is being recorded
 *   instance_frame.c       frames
 *   instance.c             set-up and its end */
#ifndef FM_INSTANCE_INTERNAL_H
#define FM_INSTANCE_INTERNAL_H

#include "instance.h"
#include "model/formula.h"

enum { INSTANCE_USES_MAX = FM_MAX_BINDINGS - SHADER_BINDING_FIRST };
_Static_assert(STAGE_SLOT_COUNT + 2 * (int)FM_MAX_RESOURCES + 1 <= (int)SHADER_TABLE_LINES,
               "a line of the table for each slot, both copies of each resource, and the locks");

/* A resource in a pass: which one, and whether the copy of the last iteration. */
typedef struct resource_ref {
    int index;
    bool is_previous;
} resource_ref;

/* A pass with all that data could say worked out. */
typedef struct built_pass {
    fm_use uses[INSTANCE_USES_MAX]; /* bindings in order; slots of ping-pong resources are
                                       swapped when the pass runs */
    size_t use_count;
    size_t stage_use_count;               /* of them, the first: read by the feed */
    resource_ref refs[INSTANCE_USES_MAX]; /* index -1: not the method's */
    fm_pipeline **pipelines;              /* one, or one an iteration where state depends on it */
    uint32_t pipeline_count;
    bool is_drawn;    /* a draw; else a dispatch */
    bool is_overfull; /* uses more than there is room for */
    bool counts;      /* its accesses; one binding more */
} built_pass;

struct fm_instance {
    fm_instance_desc desc;
    fm_choice choices[FM_MAX_OPTIONS]; /* all of the method's options, nothing left open */
    size_t choice_count;
    fm_method_desc chosen;        /* the method with the resources that its options ask for */
    const fm_method_desc *method; /* that */
    fm_device *device;
    fm_workload workload;
    uint64_t totals[FM_MAX_TOTALS];
    bool total_is_known[FM_MAX_TOTALS];
    fm_slot resources[FM_MAX_RESOURCES][2]; /* the second copy: ping-pong only */
    char previous_names[FM_MAX_RESOURCES][80];
    uint64_t grown[FM_MAX_RESOURCES]; /* elements added by overflows */
    uint32_t parity;                  /* which copy is written */
    fm_slot locks;
    fm_buffer *table; /* addresses and lengths */
    built_pass passes[FM_MAX_PASSES];
    size_t pass_count, resource_count, total_count;
    bool is_spin_locked;
    bool emits_back;
    built_pass combine, hash;                   /* of the runner's own passes, below */
    fm_buffer *counters;                        /* of accesses; NULL: they are not counted */
    char uncounted[256];                        /* why they are not, although the device can */
    uint64_t filled[FM_MAX_RESOURCES];          /* bytes, by clear passes of the running frame */
    fm_accesses accesses[FM_MAX_RESOURCES + 1]; /* of the last frame; the locks' behind the last */
};

/* instance_resources.c */
fm_status resources_create_fixed(fm_instance *instance, fm_error *err);
/* Those whose size follows the total of this number, unless they are there and large enough. */
fm_status resources_create_after(bool *was_created, fm_instance *instance, size_t total,
                                 fm_error *err);
bool resources_are_there(const fm_instance *instance, size_t total);
/* Makes room after an overflow; *grew tells whether there was one. */
fm_status resources_grow(bool *grew, fm_instance *instance, size_t total, fm_error *err);
void resources_destroy(fm_instance *instance);
/* Samples of an image resource: 1 or more. */
uint32_t resource_samples(const fm_instance *instance, const fm_resource *resource);
uint64_t resource_elements(const fm_instance *instance, size_t index);
fm_status table_upload(fm_instance *instance, fm_error *err);
/* The reference that a name in a pass means; index -1: there is no such resource. */
resource_ref resource_find(const fm_method_desc *method, const char *name);
int pass_index(const fm_method_desc *method, const char *name);

/* The slot that a reference means while the running iteration lasts. Ping-pong resources have two
 * copies: the one that is written, and the one that the last iteration wrote. */
static inline fm_slot *resource_slot(fm_instance *instance, resource_ref ref)
{
    const bool is_double = instance->method->resources[ref.index].ping_pong;
    const uint32_t written = is_double ? instance->parity : 0;
    return &instance->resources[ref.index][written ^ (ref.is_previous ? 1u : 0u)];
}

/* pass_facts.c */
/* A draw; else a dispatch. */
bool pass_is_drawn(const fm_instance *instance, const fm_pass *pass);
/* As in method.h: narrow_only. */
bool instance_is_narrow(const fm_instance *instance);
/* Not run on this device. */
bool pass_is_left_out(const fm_instance *instance, const fm_pass *pass);
/* Its place in the descriptor; FM_MAX_PASSES: the runner's own. */
uint32_t pass_number(const fm_instance *instance, const fm_pass *pass);
/* Iterations that a shader may turn in one run of a pass that resumes. */
uint32_t pass_run_iterations(const fm_instance *instance);
/* Runs until no invocation has more to do: the descriptor says so (fm_resumes), or the feed. */
bool pass_resumes(const fm_instance *instance, const fm_pass *pass);
/* Fragments that feed compute-pixel takes a run; 0: all. */
uint32_t pass_feed_step(const fm_instance *instance, const fm_pass *pass);
/* Its shader sees the scene's triangles. */
bool pass_reads_triangles(const fm_instance *instance, const fm_pass *pass);
/* Its store() is guarded by the device's interlock, not by a spin lock. */
bool pass_has_interlock(const fm_instance *instance, const fm_pass *pass);
/* Its spin lock lies in the pass's lock_word. */
bool pass_has_lock_in_word(const fm_instance *instance, const fm_pass *pass);
/* Its spin lock lies in the runner's buffer fm_locks. */
bool pass_has_own_locks(const fm_instance *instance, const fm_pass *pass);
/* Invocations of its pixels may hold their locks while they wait for a processor, and the tries for
 * them are few: each try takes its time. */
bool pass_lock_waits(const fm_instance *instance, const fm_pass *pass);
/* Its lock acquires and releases by Vulkan's memory model, instead of barriers. */
bool pass_has_memory_model(const fm_instance *instance, const fm_pass *pass);
/* The first pass that emits: it starts the picture. */
bool pass_emits_first(const fm_instance *instance, const fm_pass *pass);
/* What a scene pass draws. */
fm_geometry pass_geometry(const fm_instance *instance, const fm_pass *pass);
/* Invocations of each unit. */
uint32_t pass_lanes(const fm_instance *instance, const fm_pass *pass);
/* Pixels, tiles, triangles, ... of a dispatch, and its invocations: lanes for each. */
uint64_t pass_units(const fm_instance *instance, const fm_pass *pass);
uint64_t pass_invocations(const fm_instance *instance, const fm_pass *pass);

static inline bool pass_is_scene(const fm_pass *pass)
{
    return pass->kind == FM_PASS_SCENE;
}
static inline bool pass_has_fixed_function(const fm_pass *pass)
{
    return pass->targets[0].resource != NULL || pass->state.depth_stencil != NULL;
}

/* pass_uses.c: fills uses, refs and counts of a built pass; adds one of the stage's slots. */
void pass_use_stage(built_pass *built, fm_instance *instance, int slot, uint32_t access);
void pass_collect_uses(built_pass *built, fm_instance *instance, const fm_pass *pass);

/* pass_define.c */
void pass_define(fm_text *text, const fm_instance *instance, const fm_pass *pass);

/* instance_source.c: the fragment or compute shader of a pass. */
fm_status pass_source(fm_text *text, const built_pass *built, const fm_instance *instance,
                      const fm_pass *pass, fm_error *err);

/* instance_passes.c. The runner's own: the last pass of methods that emit from both ends, and the
 * hash of the image. */
extern const fm_pass instance_combine, instance_hash;
fm_status passes_create(fm_instance *instance, fm_error *err);
void passes_destroy(fm_instance *instance);

/* instance_bytes.c: of the spin locks; 0 without them. */
uint64_t lock_bytes(const fm_instance *instance);

/* instance_counts.c. What a pipeline is told of the resources whose accesses it counts. */
typedef struct pass_counting {
    spirv_counting desc;
    spirv_resource resources[2 * FM_MAX_RESOURCES + 1];
} pass_counting;
fm_status counts_create(fm_instance *instance, fm_error *err);
/* false: the pass is not to count. */
bool counts_describe(pass_counting *counting, const fm_instance *instance, const built_pass *built);
/* Where a pass that counts finds the counters: behind its other bindings. */
static inline uint32_t counts_binding(const built_pass *built)
{
    return SHADER_BINDING_FIRST + (uint32_t)built->use_count;
}
/* Around a frame: a recording is open when it begins, and none when it is read. */
void counts_begin(fm_instance *instance);
void counts_add_fill(fm_instance *instance, size_t index);
fm_status counts_read(fm_instance *instance, fm_error *err);

/* instance_draw.c. The frame is being recorded. */
fm_status pass_issue(fm_instance *instance, size_t index, uint32_t iteration, fm_error *err);
fm_status pass_dispatch(fm_instance *instance, const fm_pass *pass, const built_pass *built,
                        uint64_t count, fm_error *err);

#endif
