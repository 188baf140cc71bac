/* Shared by instance.c (set-up), instance_passes.c (pipelines), instance_source.c (GLSL),
 * instance_resources.c (buffers), instance_frame.c (frames) and instance_draw.c (one pass of one);
 * nobody else. */
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
} built_pass;

struct fm_instance {
    fm_instance_desc desc;
    const fm_method_desc *method;
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
    built_pass combine;
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
int resource_index(const fm_method_desc *method, const char *name, bool *is_previous);
int pass_index(const fm_method_desc *method, const char *name);

/* The copy of a resource that the running iteration writes. */
static inline fm_slot *current_copy(fm_instance *instance, int index)
{
    const bool is_double = instance->method->resources[index].ping_pong;
    return &instance->resources[index][is_double ? instance->parity : 0];
}

/* instance_draw.c. The frame is being recorded. */
/* Pixels, tiles, triangles, ... of a dispatch, and its invocations: lanes for each. */
uint64_t pass_units(const fm_instance *instance, const fm_pass *pass);
uint64_t pass_invocations(const fm_instance *instance, const fm_pass *pass);
fm_status pass_issue(fm_instance *instance, size_t index, uint32_t iteration, fm_error *err);
fm_status pass_dispatch(fm_instance *instance, const fm_pass *pass, const built_pass *built,
                        uint64_t count, fm_error *err);

static inline bool pass_is_scene(const fm_pass *pass)
{
    return pass->kind == FM_PASS_SCENE;
}
static inline bool pass_has_fixed_function(const fm_pass *pass)
{
    return pass->targets[0].resource != NULL || pass->state.depth_stencil != NULL;
}

/* instance_source.c: the fragment or compute shader of a pass. */
fm_status pass_source(fm_text *text, const built_pass *built, const fm_instance *instance,
                      const fm_pass *pass, fm_error *err);

/* instance_passes.c */
bool instance_is_narrow(const fm_instance *instance); /* as in method.h: narrow_only */
bool pass_is_left_out(const fm_instance *instance, const fm_pass *pass); /* on this device */
/* Whether its shader sees the scene's triangles. */
bool pass_reads_triangles(const fm_instance *instance, const fm_pass *pass);
/* Invocations of each unit. */
uint32_t pass_lanes(const fm_instance *instance, const fm_pass *pass);
fm_status passes_create(fm_instance *instance, fm_error *err);
void passes_destroy(fm_instance *instance);
/* What the scene pass draws. */
fm_geometry pass_geometry(const fm_instance *instance, const fm_pass *pass);

#endif
