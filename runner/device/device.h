/* Where passes run: one table of functions, implemented by vulkan/, osmesa/ and dummy/.
 *
 * A device executes what it is told, in order; it knows nothing of methods, scenes or feeds.
 * All GLSL comes in whole, from `#version 450` on, with bindings numbered by the caller: each
 * resource of a pass has a binding number that no other of that pass has (Vulkan's one name space
 * is OpenGL's too), set 0. Coordinates are Vulkan's on every device: depth 0..1, row 0 at the top
 * (NDC y = -1), gl_FragCoord.y grows downwards; flat attributes come from the first vertex.
 *
 * Ownership: whoever creates destroys; destroy functions accept NULL. A device is used by one
 * thread. Errors fill *err; after FM_DEVICE_LOST only destroy and close may be called. */
#ifndef FM_DEVICE_H
#define FM_DEVICE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/error.h"
#include "fragmark/method.h"
#include "ledger.h"

typedef struct fm_device fm_device;
typedef struct fm_buffer fm_buffer;
typedef struct fm_image_resource fm_image_resource;
typedef struct fm_pipeline fm_pipeline;

enum {
    FM_MAX_BINDINGS = 32,
    FM_MAX_TIMERS = 64,
    FM_MAX_QUERIES = 16,
};

/* What this device is and can do. */
typedef struct fm_device_caps {
    char name[128];    /* "llvmpipe (LLVM 15.0.6, 256 bits)", "NVIDIA H100 80GB HBM3" */
    char driver[128];  /* name and version */
    char api[64];      /* "Vulkan 1.3.230", "OpenGL 4.5 (core)" */
    uint32_t features; /* FM_FEATURE_* */
    bool is_software;
    bool has_gpu_clock;       /* its clock falls when idle: canaries tell (see fm_frame_times) */
    bool needs_helper_guard;  /* helper lanes reach atomics: shaders leave before any lock */
    bool needs_lock_barriers; /* memory barriers around a lock's section are needed (and work) */
    uint32_t loop_limit;      /* most iterations of all loops of an invocation; 0: none */
    uint32_t subgroup_size;
    uint32_t colour_samples, depth_samples; /* bit s set: s samples are possible */
    uint32_t max_targets;
    uint64_t storage_range_bytes; /* largest bound storage buffer */
    uint64_t buffer_max_bytes; /* largest buffer by address; 0 without FM_FEATURE_BUFFER_ADDRESS */
    uint64_t memory_bytes;     /* device memory; 0: not known */
    uint32_t max_groups[3];    /* workgroups in a dispatch */
    double timestamp_ns;       /* one tick; 0: no timestamps */
} fm_device_caps;

/* How a device is opened. Zero is the default. */
typedef struct fm_device_desc {
    const char *selector; /* after the colon of "vulkan:INDEX|NAME"; NULL: the first */
    bool validation;      /* API validation with synchronization checks, if it is installed */
    bool no_timers;       /* timers do nothing, so that barriers come from accesses alone */
} fm_device_desc;

/* One line of `fragmark list devices`. */
typedef struct fm_device_entry {
    char selector[32]; /* what --device takes: "vulkan:0" */
    char name[128];
} fm_device_entry;

typedef struct fm_buffer_desc {
    const char *name;
    uint64_t bytes; /* > 0 */
    fm_owner owner;
    bool is_vertex, is_index, is_uniform, is_indirect; /* storage always */
    bool by_address; /* reached through fm_buffer_address, not through a binding */
    bool host_reads; /* read back often: counters */
} fm_buffer_desc;

typedef struct fm_image_desc {
    const char *name;
    fm_format format;
    uint32_t width_px, height_px;
    uint32_t layers;  /* 0 is 1 */
    uint32_t samples; /* 0 is 1 */
    fm_owner owner;
} fm_image_desc;

typedef enum fm_binding_kind {
    FM_BINDING_UNIFORM,
    FM_BINDING_STORAGE, /* buffer */
    FM_BINDING_ADDRESS, /* buffer reached by address: listed for barriers only */
    FM_BINDING_SAMPLED, /* image through [u]sampler2D[MS][Array] and texelFetch */
    FM_BINDING_STORAGE_IMAGE,
} fm_binding_kind;

typedef struct fm_pipeline_binding {
    uint32_t binding;
    fm_binding_kind kind; /* never FM_BINDING_ADDRESS */
} fm_pipeline_binding;

typedef struct fm_target_desc {
    fm_format format;
    fm_blend blend;
    bool no_write;
} fm_target_desc;

/* A vertex attribute stream: one buffer, tightly described. */
typedef struct fm_vertex_attribute {
    uint32_t location;
    fm_element element;
    bool is_vec3; /* three floats */
    uint32_t offset_bytes;
} fm_vertex_attribute;

/* compute alone, or vertex and fragment. */
typedef struct fm_pipeline_desc {
    const char *name; /* in messages: "kplus-array: store" */
    const char *compute;
    const char *vertex, *fragment; /* GLSL */
    fm_state state;
    uint32_t iteration; /* for the values of state that depend on it */
    fm_target_desc targets[FM_MAX_TARGETS];
    uint32_t target_count;
    fm_format depth_stencil;      /* FM_FORMAT_NONE: none */
    uint32_t samples;             /* 0 is 1 */
    uint32_t vertex_stride_bytes; /* 0: no vertex buffer, gl_VertexIndex only */
    fm_vertex_attribute attributes[4];
    uint32_t attribute_count;
    fm_pipeline_binding bindings[FM_MAX_BINDINGS];
    uint32_t binding_count;
} fm_pipeline_desc;

enum { FM_ACCESS_READ = 1u, FM_ACCESS_WRITE = 2u };

/* One resource of a draw or dispatch. Exactly one of buffer and image is set. */
typedef struct fm_bind {
    uint32_t binding;
    fm_binding_kind kind;
    fm_buffer *buffer;
    fm_image_resource *image;
    uint32_t access; /* FM_ACCESS_*: barriers follow from it */
} fm_bind;

typedef struct fm_dispatch {
    const fm_pipeline *pipeline;
    const fm_bind *binds;
    uint32_t bind_count;
    uint32_t groups[3];
    fm_buffer *indirect; /* instead of groups: three uints at offset 0 */
} fm_dispatch;

typedef struct fm_draw {
    const fm_pipeline *pipeline;
    const fm_bind *binds;
    uint32_t bind_count;
    uint32_t width_px, height_px; /* viewport and render area */
    fm_image_resource *targets[FM_MAX_TARGETS];
    fm_load target_loads[FM_MAX_TARGETS];
    float target_clears[FM_MAX_TARGETS][4]; /* integer formats: the bits of each float */
    uint32_t target_count;
    fm_image_resource *depth_stencil;
    fm_load depth_stencil_load;
    float clear_depth;
    uint32_t clear_stencil;
    fm_buffer *vertices;   /* NULL: none */
    fm_buffer *indices;    /* NULL: not indexed; 32-bit */
    uint32_t vertex_count; /* or index count */
    uint32_t instance_count;
    int query; /* counts the samples that pass into this slot; -1: none */
} fm_draw;

/* Results of a frame. */
typedef struct fm_frame_times {
    uint64_t timer_ns[FM_MAX_TIMERS]; /* 0 where the timer did not run */
    uint64_t query[FM_MAX_QUERIES];   /* samples passed */
    uint64_t wall_ns;                 /* host: from frame_begin to the end of waiting */
} fm_frame_times;

/* The table. Functions that can fail return fm_status and fill *err. */
typedef struct fm_device_ops {
    const char *name; /* "vulkan" */
    uint32_t feeds;   /* FM_FEED_*; 0 is all but frames. A device of feed `frames` alone runs no
                         passes: of the functions below only those up to validation_errors count */

    /* Lists what could be opened; *count is in: room, out: how many. */
    fm_status (*list)(fm_device_entry *entries, size_t *count, fm_error *err);
    /* FM_UNSUPPORTED: no such driver here, with how to get one. */
    fm_status (*open)(fm_device **device, const fm_device_desc *desc, fm_error *err);
    void (*close)(fm_device *device);
    /* Messages of the validation layer so far (0 without it), and the first of them or "". */
    uint32_t (*validation_errors)(const fm_device *device, const char **first);

    /* FM_NO_MEMORY: no room; FM_UNSUPPORTED: larger than the device's range, with both numbers. */
    fm_status (*buffer_create)(fm_buffer **buffer, fm_device *device, const fm_buffer_desc *desc,
                               fm_error *err);
    void (*buffer_destroy)(fm_device *device, fm_buffer *buffer);
    uint64_t (*buffer_address)(const fm_buffer *buffer); /* 0 unless by_address */
    /* Outside frames; wait for the device. Bounds are asserted. */
    fm_status (*buffer_write)(fm_device *device, fm_buffer *buffer, uint64_t offset_bytes,
                              const void *bytes, uint64_t count, fm_error *err);
    fm_status (*buffer_read)(fm_device *device, fm_buffer *buffer, uint64_t offset_bytes,
                             void *bytes, uint64_t count, fm_error *err);

    fm_status (*image_create)(fm_image_resource **image, fm_device *device,
                              const fm_image_desc *desc, fm_error *err);
    void (*image_destroy)(fm_device *device, fm_image_resource *image);

    /* FM_SHADER: the compiler's message, with the line of the GLSL it speaks of quoted. */
    fm_status (*pipeline_create)(fm_pipeline **pipeline, fm_device *device,
                                 const fm_pipeline_desc *desc, fm_error *err);
    void (*pipeline_destroy)(fm_device *device, fm_pipeline *pipeline);

    /* A frame: begin, any of the calls between, end (submits, waits, reads timers and queries).
     * After an error in between, end must still be called. */
    fm_status (*frame_begin)(fm_device *device, fm_error *err);
    fm_status (*frame_end)(fm_device *device, fm_frame_times *times, fm_error *err);
    /* An interval of GPU time: all work before timer_begin is done before it starts, all work
     * before timer_end is done when it ends. Timers do not nest. A timer used twice in a frame
     * adds up. Empty ones are clock canaries. */
    void (*timer_begin)(fm_device *device, uint32_t timer);
    void (*timer_end)(fm_device *device, uint32_t timer);
    void (*fill)(fm_device *device, fm_buffer *buffer, uint32_t word);
    void (*update)(fm_device *device, fm_buffer *buffer, uint64_t offset_bytes, const void *bytes,
                   uint32_t count); /* 65 536 bytes at most, multiples of 4 */
    void (*image_clear)(fm_device *device, fm_image_resource *image, const float colour[4],
                        float depth, uint32_t stencil);
    fm_status (*dispatch)(fm_device *device, const fm_dispatch *dispatch, fm_error *err);
    fm_status (*draw)(fm_device *device, const fm_draw *draw, fm_error *err);
} fm_device_ops;

/* First member of every device's own struct. */
struct fm_device {
    const fm_device_ops *ops;
    fm_device_caps caps;
    fm_ledger ledger;
};

#endif
