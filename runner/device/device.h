/* What executes passes: the interface of all devices, and their manual.
 *
 * A device is a table of functions (fm_device_ops) behind a handle. vulkan/, osmesa/ and dummy/
 * fill a table each; the simulator fills the part that lists and opens, because it runs sequences
 * of frames instead (simulator/sequence_device.h). Programs look devices up in a list of their own
 * (registry.h).
 *
 * What lives in this room: this interface; registry.c, which looks names up; and what
 * implementations share: ledger.c books bytes, selector.c reads the part of a name behind its
 * colon, dispatch.c checks workgroups, shader_fault.c reports GLSL that does not compile. Below it
 * each device has a folder, and uses nothing of another. What may not: methods, scenes, feeds but
 * by their bits, and any device by its name.
 *
 * A device executes what it is told, in order; it knows nothing of methods, scenes or feeds. All
 * GLSL comes in whole, from `#version 450` on, with bindings numbered by the caller: each resource
 * of a pass has a binding number that no other of that pass has (Vulkan's one name space is
 * OpenGL's too), set 0. Coordinates are Vulkan's on every device: depth 0..1, row 0 at the top
 * (NDC y = -1), gl_FragCoord.y grows downwards; flat attributes come from the first vertex.
 *
 * Ownership: whoever creates destroys, before the device is closed; destroy functions accept NULL.
 * Descriptors, and all they point at, are borrowed for the call. What a command of a frame names
 * must live until frame_end.
 * Threads: a device and all that it made are used by one thread. Two devices in a process do not
 * know of each other.
 * Errors: functions that can fail return a status and fill *err, which may be NULL. Messages name
 * the buffer, image or pipeline. FM_DEVICE_LOST: the driver or the GPU failed; then the frame
 * is ended if there is one, and only destroy functions and close may follow. FM_UNSUPPORTED, by
 * fm_refuse with its reason: this device cannot do it, and nothing was done; a row of the results
 * says so and is no failure. What only a mistake in the caller can break (bounds, a missing
 * pipeline) is asserted. */
#ifndef FM_DEVICE_H
#define FM_DEVICE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/error.h"
#include "cache/cache.h"
#include "fragmark/method.h" /* formats, elements, fixed-function state, FM_FEATURE_*, FM_FEED_* */
#include "ledger.h"
#include "spirv/accesses.h"

typedef struct fm_device fm_device;                 /* an open device; see the end of this file */
typedef struct fm_buffer fm_buffer;                 /* bytes on the device */
typedef struct fm_image_resource fm_image_resource; /* texels on the device */
typedef struct fm_pipeline fm_pipeline;             /* compiled shaders and fixed-function state */

enum {
    FM_MAX_BINDINGS = 32,  /* resources of a draw or dispatch, without buffers by address */
    FM_MAX_TIMERS = 64,    /* timers of a frame, each used as often as wanted */
    FM_MAX_QUERIES = 16,   /* slots that count samples, likewise */
    FM_MAX_ATTRIBUTES = 4, /* of a vertex */
};

/* What a device is and can do; filled by open, then constant. Texts end with NUL, cut if need be.
 */
typedef struct fm_device_caps {
    char name[128];         /* "llvmpipe (LLVM 15.0.6, 256 bits)", "NVIDIA H100 80GB HBM3" */
    char driver[128];       /* name and version */
    char api[64];           /* "Vulkan 1.3.230", "OpenGL 4.5 (core)"; "none": nothing is drawn */
    char driver_build[160]; /* what tells this build of the driver from all others; "": it is a part
                               of the program */
    uint32_t features;      /* FM_FEATURE_* bits of what shaders may use */
    bool is_software;       /* the host's processors do the work, and its memory holds everything */
    bool has_gpu_clock;     /* its clock falls when idle: empty timers show by how much */
    bool needs_helper_guard;  /* helper lanes reach atomics: shaders leave before any lock */
    bool needs_lock_barriers; /* memory barriers around a lock's section are needed (and work) */
    bool counts_accesses;     /* fm_pipeline_desc.counting can be */
    bool has_memory_model;    /* shaders may use Vulkan's, with the scope of the whole device */
    uint32_t loop_limit;      /* most iterations of all loops of an invocation, after which they end
                                 without a word; 0: none */
    uint32_t subgroup_size;   /* lanes; 0: not known */
    uint32_t colour_samples;  /* bit s set: images of every colour format can have s samples */
    uint32_t depth_samples;   /* the same for formats with depth; 0: some format is missing */
    uint32_t max_targets;     /* of a draw, FM_MAX_TARGETS at most */
    uint64_t storage_range_bytes; /* largest buffer that is bound (FM_BINDING_STORAGE) */
    uint64_t buffer_max_bytes;    /* largest by address; 0: without FM_FEATURE_BUFFER_ADDRESS */
    uint32_t image_layers;        /* most layers of an image */
    uint64_t image_max_bytes;     /* largest image, of all its layers */
    uint64_t memory_bytes;        /* of the device, its largest heap; 0: not known */
    uint32_t max_groups[3];       /* workgroups of a dispatch, for each axis */
    double timestamp_ns;          /* one tick of the device's clock; 0: timers read 0 */
} fm_device_caps;

/* How a device is opened. Zero is the default. */
typedef struct fm_device_desc {
    const char *selector; /* which of a driver's devices (selector.h); NULL: the first */
    bool validation;      /* API validation, on Vulkan with synchronization checks; FM_UNSUPPORTED
                             where it is not installed */
    bool no_timers;       /* timers do nothing, so that barriers come from accesses alone */
    fm_cache *cache;      /* of compiled shaders; lives as long as the device; NULL: none */
} fm_device_desc;

/* One line of `fragmark list devices`. */
typedef struct fm_device_entry {
    char selector[32]; /* what --device takes: "vulkan:0" */
    char name[128];    /* for people, as fm_device_caps.name where that is known unopened */
} fm_device_entry;

/* A buffer: bytes without a type. Every buffer can be bound as storage, filled and updated. */
typedef struct fm_buffer_desc {
    const char *name; /* in messages */
    uint64_t bytes;   /* > 0; storage is padded to words, so that a fill reaches the last byte */
    fm_owner owner;   /* who the ledger books it for */
    bool is_vertex;   /* it may be fm_draw.vertices */
    bool is_index;    /* ... fm_draw.indices */
    bool is_uniform;  /* ... bound as FM_BINDING_UNIFORM, whose range is smaller */
    bool is_indirect; /* ... fm_dispatch.indirect */
    bool by_address;  /* shaders reach it through buffer_address, not through a binding */
    bool host_reads;  /* read back often, such as counters: it lies where the host reads fast */
} fm_buffer_desc;

/* An image of two dimensions without mipmaps. Every image can be sampled, drawn into and cleared;
 * shaders can store into it where the device has that for its format and samples. */
typedef struct fm_image_desc {
    const char *name;             /* in messages */
    fm_format format;             /* not FM_FORMAT_NONE */
    uint32_t width_px, height_px; /* > 0 */
    uint32_t layers;              /* 0 is 1; more make an array in shaders: sampler2DArray */
    bool is_array;                /* one layer does, too */
    uint32_t samples;             /* 0 is 1; more make sampler2DMS; a bit of caps.*_samples */
    fm_owner owner;               /* who the ledger books it for */
} fm_image_desc;

/* How shaders reach a resource. */
typedef enum fm_binding_kind {
    FM_BINDING_UNIFORM,       /* buffer: a std140 block, read only */
    FM_BINDING_STORAGE,       /* buffer: a std430 block */
    FM_BINDING_ADDRESS,       /* buffer reached by address: listed for barriers only */
    FM_BINDING_SAMPLED,       /* image through [u]sampler2D[MS][Array] and texelFetch */
    FM_BINDING_STORAGE_IMAGE, /* image through [u]image2D[MS][Array] */
} fm_binding_kind;

/* A binding that the shaders of a pipeline declare. */
typedef struct fm_pipeline_binding {
    uint32_t binding;     /* the number in `layout(binding = ...)` */
    fm_binding_kind kind; /* never FM_BINDING_ADDRESS */
} fm_pipeline_binding;

/* A colour attachment of a pipeline: output `layout(location = index)` of its fragment shader. */
typedef struct fm_target_desc {
    fm_format format; /* that of the image which a draw attaches; no depth format */
    fm_blend blend;   /* FM_UNSUPPORTED where this device cannot blend the format */
    bool no_write;    /* colour mask off: what is there stays */
} fm_target_desc;

/* A vertex attribute: `layout(location = ...) in` of the vertex shader. */
typedef struct fm_vertex_attribute {
    uint32_t location;     /* of no other attribute */
    fm_element element;    /* its type; FM_ELEMENT_UINT64 arrives as a uvec2 */
    bool is_vec3;          /* instead: three floats */
    uint32_t offset_bytes; /* in a vertex; a multiple of 4 */
} fm_vertex_attribute;

/* Shaders and state: `compute` alone, or `vertex` and `fragment`. Triangles are drawn as lists,
 * whichever way they face. */
typedef struct fm_pipeline_desc {
    const char *name;     /* in messages: "kplus-array: store" */
    const char *compute;  /* GLSL; NULL for draws */
    const char *vertex;   /* GLSL; NULL for dispatches */
    const char *fragment; /* with `vertex` */
    fm_state state;       /* without depth_stencil, its load and early_tests: draws and
                             shaders say those */
    uint32_t iteration;   /* i of what fm_state says of values that depend on it */
    fm_target_desc targets[FM_MAX_TARGETS];
    uint32_t target_count;        /* caps.max_targets at most */
    fm_format depth_stencil;      /* that of the image which draws attach; FM_FORMAT_NONE: none */
    uint32_t samples;             /* of all attachments, or of none at all; 0 is 1 */
    uint32_t vertex_stride_bytes; /* 0: no vertex buffer, gl_VertexIndex only */
    fm_vertex_attribute attributes[FM_MAX_ATTRIBUTES]; /* all from one vertex buffer */
    uint32_t attribute_count;
    fm_pipeline_binding bindings[FM_MAX_BINDINGS]; /* each number once */
    uint32_t binding_count;
    const spirv_counting *counting; /* the compute or fragment shader counts its accesses of these
                                       resources, into a buffer that is among the bindings; NULL:
                                       it does not */
} fm_pipeline_desc;

/* What shaders of a command do with a resource; 0: nothing that a barrier has to know. */
enum {
    FM_ACCESS_READ = 1u,
    FM_ACCESS_WRITE = 2u, /* atomics read and write */
};

/* One resource of a draw or dispatch. Exactly one of buffer and image is set. */
typedef struct fm_bind {
    uint32_t binding;         /* of the pipeline; not read for FM_BINDING_ADDRESS */
    fm_binding_kind kind;     /* as the pipeline has it */
    fm_buffer *buffer;        /* all of it is bound */
    fm_image_resource *image; /* all layers are bound */
    uint32_t access;          /* FM_ACCESS_*: barriers follow from it, and from nothing else */
} fm_bind;

/* Workgroups of a compute shader. */
typedef struct fm_dispatch {
    const fm_pipeline *pipeline; /* with a compute shader */
    const fm_bind *binds;        /* [bind_count]: the pipeline's bindings, and buffers by address */
    uint32_t bind_count;
    uint32_t groups[3];  /* workgroups along x, y, z: caps.max_groups at most */
    fm_buffer *indirect; /* instead of groups: three uints at offset 0, read on the device */
} fm_dispatch;

/* Triangles. Pixels outside width_px x height_px, from the upper left, are not touched. */
typedef struct fm_draw {
    const fm_pipeline *pipeline; /* with vertex and fragment shaders */
    const fm_bind *binds;        /* [bind_count]: the pipeline's bindings, and buffers by address */
    uint32_t bind_count;
    uint32_t width_px, height_px; /* viewport and render area: no larger than an attachment */
    fm_image_resource
        *targets[FM_MAX_TARGETS];           /* as the pipeline has them; layer 0 is drawn into */
    fm_load target_loads[FM_MAX_TARGETS];   /* what happens to them before */
    float target_clears[FM_MAX_TARGETS][4]; /* integer formats: the bits of each float */
    uint32_t target_count;                  /* the pipeline's */
    fm_image_resource *depth_stencil;       /* layer 0; NULL where the pipeline has none */
    fm_load depth_stencil_load;
    float clear_depth;      /* 0..1 */
    uint32_t clear_stencil; /* 0..255 */
    fm_buffer *vertices;    /* NULL: none */
    fm_buffer *indices;     /* 32-bit, from offset 0; NULL: vertices in their order */
    uint32_t vertex_count;  /* or the count of indices: three a triangle */
    uint32_t instance_count;
    int query; /* slot below FM_MAX_QUERIES that counts the samples that pass; -1 (not 0): none */
} fm_draw;

/* What was measured of a frame. */
typedef struct fm_frame_times {
    uint64_t timer_ns[FM_MAX_TIMERS]; /* all intervals of the timer; 0: it did not run */
    uint64_t query[FM_MAX_QUERIES];   /* samples that passed, of all draws with this slot */
    uint64_t wall_ns;                 /* the host's clock, from frame_begin to the end of waiting */
} fm_frame_times;

/* The table: one constant for each kind of device. Functions are called through device->ops, but
 * for list and open, which come before there is a device. */
typedef struct fm_device_ops {
    const char *name; /* "vulkan": what a name in --device begins with; no colon in it */
    uint32_t feeds;   /* FM_FEED_* that it takes; 0 is all but frames. A device of feed `frames`
                         alone runs no passes: what follows validation_errors may be NULL */

    /* Lists what could be opened. *count: in, how many entries there is room for; out, how many
     * were filled. Without a driver that is 0, and FM_OK. */
    fm_status (*list)(fm_device_entry *entries, size_t *count, fm_error *err);
    /* Opens a device, which the caller ends with close. FM_UNSUPPORTED: the device lacks what
     * every method needs. Else it says nothing of the device: FM_IO: no driver works here, with how
     * to get one; FM_INVALID: the selector fits none, with those that there are; FM_NO_MEMORY.
     * On failure *device is NULL. */
    fm_status (*open)(fm_device **device, const fm_device_desc *desc, fm_error *err);
    /* Accepts NULL. A GPU that hangs is left alone with all that it may still work on. */
    void (*close)(fm_device *device);
    /* Messages of the validation layer so far (0 without it), and the first of them or "", which
     * lives as long as the device. */
    uint32_t (*validation_errors)(const fm_device *device, const char **first);

    /* Makes a buffer of unknown contents. FM_NO_MEMORY: no room; FM_UNSUPPORTED: larger than the
     * device's range, with both numbers, or by address where there are none. */
    fm_status (*buffer_create)(fm_buffer **buffer, fm_device *device, const fm_buffer_desc *desc,
                               fm_error *err);
    void (*buffer_destroy)(fm_device *device, fm_buffer *buffer);
    /* What shaders take for a buffer_reference; 0 unless by_address. */
    uint64_t (*buffer_address)(const fm_buffer *buffer);
    /* Copies `count` bytes from or to the host. Outside frames; they wait for the device. The range
     * lies within the buffer, which is asserted. FM_DEVICE_LOST. */
    fm_status (*buffer_write)(fm_device *device, fm_buffer *buffer, uint64_t offset_bytes,
                              const void *bytes, uint64_t count, fm_error *err);
    fm_status (*buffer_read)(fm_device *device, fm_buffer *buffer, uint64_t offset_bytes,
                             void *bytes, uint64_t count, fm_error *err);

    /* Makes an image of unknown contents. FM_NO_MEMORY; FM_UNSUPPORTED: sides, layers, samples or a
     * format that this device does not have. */
    fm_status (*image_create)(fm_image_resource **image, fm_device *device,
                              const fm_image_desc *desc, fm_error *err);
    void (*image_destroy)(fm_device *device, fm_image_resource *image);

    /* Compiles. FM_SHADER: the compiler's message, with the line of the GLSL it speaks of quoted.
     * FM_UNSUPPORTED: more bindings or targets than a shader can have here, a blended format that
     * cannot be, a driver that gives up on the shader, or accesses that cannot be counted. */
    fm_status (*pipeline_create)(fm_pipeline **pipeline, fm_device *device,
                                 const fm_pipeline_desc *desc, fm_error *err);
    void (*pipeline_destroy)(fm_device *device, fm_pipeline *pipeline);

    /* A frame: begin, any of the calls that follow it here, end. Commands run in order, each as if
     * it had waited for the accesses of those before that its own depend on. frame_end returns when
     * all work is done. After an error in between, end must still be called; its times are then
     * of what ran. */
    fm_status (*frame_begin)(fm_device *device, fm_error *err);
    fm_status (*frame_end)(fm_device *device, fm_frame_times *times, fm_error *err);
    /* An interval of GPU time: all work before timer_begin is done before it starts, all work
     * before timer_end is done when it ends. timer: below FM_MAX_TIMERS. Intervals do not nest. A
     * timer used twice in a frame adds up. An empty one shows what a timestamp costs and, on a GPU,
     * whether its clock has fallen. Too many for the device make frame_end FM_UNSUPPORTED. */
    void (*timer_begin)(fm_device *device, uint32_t timer);
    void (*timer_end)(fm_device *device, uint32_t timer);
    /* Every word of the buffer becomes this one. */
    void (*fill)(fm_device *device, fm_buffer *buffer, uint32_t word);
    /* Writes bytes that are copied now: 65 536 at most; offset and count are multiples of 4. */
    void (*update)(fm_device *device, fm_buffer *buffer, uint64_t offset_bytes, const void *bytes,
                   uint32_t count);
    /* Clears all layers and samples: to the colour, of which integer formats take the bits of each
     * float, or to depth (0..1) and, where the format has it, stencil (0..255). */
    void (*image_clear)(fm_device *device, fm_image_resource *image, const float colour[4],
                        float depth, uint32_t stencil);
    /* FM_UNSUPPORTED: too many workgroups, or an image that shaders cannot store into here. */
    fm_status (*dispatch)(fm_device *device, const fm_dispatch *dispatch, fm_error *err);
    /* FM_UNSUPPORTED: attachments that do not fit together, more vertices than the API counts,
     * queries that cannot count exactly, or an image that shaders cannot store into here.
     * FM_INVALID, which only Vulkan looks for: an attachment smaller than the area. */
    fm_status (*draw)(fm_device *device, const fm_draw *draw, fm_error *err);
} fm_device_ops;

/* An open device. It is the first member of every device's own struct, which open fills; callers
 * read it and change nothing. */
struct fm_device {
    const fm_device_ops *ops; /* the table of its kind */
    fm_device_caps caps;      /* constant */
    fm_ledger ledger;         /* of the buffers and images that are not destroyed yet */
};

#endif
