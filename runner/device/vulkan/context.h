/* What the files of this folder share: the device's struct, its objects, and their functions. Files
 * that have one in osmesa/ with the same work have its name, too.
 *
 *   vulkan.c          the table of functions; list, open, close
 *   instance.c        the loader's instance, validation, the devices it offers
 *   logical_device.c  the device, with those features that shaders here may use
 *   caps.c            what fm_device_caps says
 *   result.c          a VkResult as an error
 *   buffer.c          buffers, and memory for them and images, of the type that fits
 *   transfer.c        their reads and writes; commands outside frames, and submitting any
 *   image.c           images and their formats
 *   shader.c          shaders as modules, and what the driver made of their pipelines before
 *   pipeline.c        pipelines; state.c: fixed-function state from the interface's enums
 *   barrier.c         which accesses have to wait for which
 *   frame.c           begin and end, timers and queries
 *   command.c         fill, update, clear, dispatch, draw; bind.c: what their shaders see
 *
 * Images stay in VK_IMAGE_LAYOUT_GENERAL all their life: barriers are then memory barriers only. */
#ifndef FM_VULKAN_CONTEXT_H
#define FM_VULKAN_CONTEXT_H

#include <vulkan/vulkan.h>

#include "device/device.h"
#include "device/glsl/glsl.h"

enum {
    VULKAN_TIMESTAMPS_MAX = 2 * 4096, /* two for each interval of a frame */
    VULKAN_OCCLUSIONS_MAX = 4096,     /* draws with a query in a frame */
    VULKAN_DEVICES_MAX = 16,          /* that the loader offers; more are not seen */
};

/* No wait for a GPU is longer: a frame that takes a minute has hung. Software does not hang, it is
 * slow: who waits for its process says how long. */
#define VULKAN_WAIT_NS (60ull * 1000 * 1000 * 1000)

/* The accesses to a resource since `epoch` began; older ones are complete and visible. */
typedef struct vulkan_access {
    uint64_t epoch; /* vulkan.epoch when the rest was noted; another one: nothing is known */
    VkPipelineStageFlags2 write_stages; /* of the last write; 0: none in this epoch */
    VkAccessFlags2 write_access;
    VkPipelineStageFlags2 read_stages; /* since that write */
    /* Where the last barrier has made the write visible. */
    VkPipelineStageFlags2 visible_stages;
    VkAccessFlags2 visible_access;
} vulkan_access;

struct fm_buffer {
    VkBuffer buffer;
    VkDeviceMemory memory;   /* its own, whole */
    void *mapped;            /* NULL: reached through staging */
    bool is_cached;          /* host reads of `mapped` are fast */
    VkDeviceAddress address; /* 0 unless it was asked for */
    uint64_t bytes;          /* as asked and booked; the VkBuffer is rounded up to words */
    fm_owner owner;
    vulkan_access access;
};

struct fm_image_resource {
    VkImage image;
    VkDeviceMemory memory;      /* its own, whole */
    VkImageView target_view;    /* layer 0, all aspects */
    VkImageView shader_view;    /* all layers, colour or depth */
    VkImageAspectFlags aspects; /* all: colour, or depth and perhaps stencil */
    uint32_t width_px, height_px;
    char name[64];  /* in messages */
    bool can_store; /* shaders may store into it: the device could make it so */
    uint64_t bytes; /* as booked */
    fm_owner owner;
    vulkan_access access;
};

struct fm_pipeline {
    VkPipeline pipeline;
    VkPipelineLayout layout;          /* of one set */
    VkDescriptorSetLayout set_layout; /* of set 0: what fm_pipeline_desc.bindings say */
    VkPipelineBindPoint bind_point;   /* compute or graphics */
};

/* Queries of one kind, given out one after the other during a frame. slot[i] is the caller's timer
 * or query that result i is added to. */
typedef struct vulkan_query_pool {
    VkQueryPool pool;
    uint32_t count, capacity; /* given out in this frame; that there are */
    uint8_t *slot;            /* [capacity]; owned */
} vulkan_query_pool;

/* Descriptor pools of a frame, reset when the next begins. They are made as they are needed, and
 * kept: a frame like the last one makes none. */
typedef struct vulkan_descriptors {
    VkDescriptorPool *pools; /* [count]; owned */
    uint32_t count, current; /* current: where the next set comes from; count: nowhere yet */
} vulkan_descriptors;

/* What the validation layer said; all zero without it. */
typedef struct vulkan_validation {
    VkDebugUtilsMessengerEXT messenger;
    uint32_t errors;  /* messages so far */
    char first[1024]; /* of them, cut if need be */
} vulkan_validation;

/* The device; zero before open. What stands here is its own, and ends with close. */
typedef struct vulkan {
    fm_device base; /* first: a fm_device is cast to this */
    VkInstance instance;
    vulkan_validation validation;
    VkPhysicalDevice physical; /* the one that the selector chose */
    VkPhysicalDeviceMemoryProperties memory;
    VkPhysicalDeviceLimits limits;
    VkDevice device;
    VkQueue queue;         /* one, for graphics and compute */
    uint32_t queue_family; /* its */
    VkCommandPool commands;
    VkCommandBuffer frame_commands;    /* between frame_begin and frame_end */
    VkCommandBuffer transfer_commands; /* outside frames: transfer.c */
    VkFence fence;                     /* of what was submitted last; reset when it is done */
    VkSampler sampler;                 /* nearest: images are read with texelFetch */
    glsl_compiler compiler;
    fm_buffer *staging; /* of transfers */
    vulkan_descriptors descriptors;
    vulkan_query_pool timestamps, occlusions;
    uint64_t timestamp_mask;     /* bits that a timestamp has; the rest is noise */
    bool can_store_multisampled; /* shaders, into images of several samples */
    bool can_query_precisely;    /* occlusion queries count; else they say whether any passed */
    bool no_timers;              /* asked for, or the queue has no timestamps */
    bool timers_overflowed;      /* told by frame_end: timers return nothing */
    bool has_hung;  /* the GPU did not answer: its objects are still in use and are left alone */
    uint64_t epoch; /* counts full barriers: what a vulkan_access says is of one epoch */
    uint64_t frame_start_ns; /* the host's clock at frame_begin */
} vulkan;

/* result.c. "WHAT: device lost (VkResult -4)" with the status that fits; FM_DEVICE_LOST for results
 * that are not known. `format` and what follows say WHAT, without a colon at the end. */
fm_status vulkan_fail(fm_error *err, VkResult result, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* instance.c. The messenger counts into *validation, which must outlive the instance. */
fm_status vulkan_instance_create(VkInstance *instance, vulkan_validation *validation,
                                 bool wants_validation, fm_error *err);
void vulkan_instance_destroy(VkInstance instance, vulkan_validation *validation);
/* Devices with Vulkan 1.3 and a queue for graphics and compute, GPUs first. */
fm_status vulkan_find_devices(VkPhysicalDevice found[VULKAN_DEVICES_MAX], size_t *count,
                              VkInstance instance, fm_error *err);
uint32_t vulkan_queue_family(VkPhysicalDevice physical); /* UINT32_MAX: none */

/* caps.c. Fills self->base.caps, but for features, and the limits beside it, from self->physical
 * and self->queue_family. */
void vulkan_caps_find(vulkan *self);

/* logical_device.c. Creates self->device and self->queue, with what features the device has of
 * those that shaders here may use, and says which in self->base.caps. FM_UNSUPPORTED: it lacks one
 * that nothing here can do without. */
fm_status vulkan_logical_device_create(vulkan *self, fm_error *err);

/* image.c. What Vulkan calls a format, and which aspects its images have. */
typedef struct vulkan_format {
    VkFormat format; /* VK_FORMAT_UNDEFINED for FM_FORMAT_NONE */
    bool has_depth, has_stencil;
} vulkan_format;
const vulkan_format *vulkan_format_of(fm_format format);
/* What every image of a format is used for: shaders read it, draws write it, it is cleared. */
VkImageUsageFlags vulkan_format_usage(fm_format format);
/* How large images of a format can be with this usage; false: they cannot be made at all. */
bool vulkan_format_limits(VkImageFormatProperties *limits, VkPhysicalDevice physical,
                          fm_format format, VkImageUsageFlags usage);
/* Sample counts that images of all formats from first to last can have; bit s: s samples. */
uint32_t vulkan_format_samples(VkPhysicalDevice physical, fm_format first, fm_format last);
/* A clear value: integer formats take the bits of each float. */
VkClearColorValue vulkan_clear_colour(const float colour[4]);

/* buffer.c. */
typedef enum vulkan_memory_kind {
    VULKAN_MEMORY_DEVICE,   /* near the GPU */
    VULKAN_MEMORY_COUNTERS, /* near the GPU, and read by the host if it can be */
    VULKAN_MEMORY_STAGING,  /* the host's, from which the GPU copies */
} vulkan_memory_kind;
typedef struct vulkan_memory_desc {
    VkMemoryRequirements needs; /* of the buffer or image */
    vulkan_memory_kind kind;
    bool has_address; /* of a buffer whose address is asked for */
} vulkan_memory_desc;
typedef struct vulkan_memory {
    VkDeviceMemory memory; /* the caller frees it; VK_NULL_HANDLE on failure */
    bool can_map;          /* by the host, without flushing */
    bool is_cached;        /* and its reads are fast */
} vulkan_memory;
/* FM_NO_MEMORY; FM_UNSUPPORTED: no type of memory fits. The message names neither buffer nor image:
 * the caller puts it before. */
fm_status vulkan_memory_allocate(vulkan_memory *memory, const vulkan *self,
                                 const vulkan_memory_desc *desc, fm_error *err);

/* buffer.c */
fm_status vulkan_buffer_create(fm_buffer **buffer, fm_device *device, const fm_buffer_desc *desc,
                               fm_error *err);
void vulkan_buffer_destroy(fm_device *device, fm_buffer *buffer);
uint64_t vulkan_buffer_address(const fm_buffer *buffer);
/* The mapped buffer through which transfers go. It is in no ledger. */
fm_status vulkan_staging_create(fm_buffer **staging, const vulkan *self, fm_error *err);
void vulkan_staging_destroy(const vulkan *self, fm_buffer *staging);

/* transfer.c */
fm_status vulkan_buffer_write(fm_device *device, fm_buffer *buffer, uint64_t offset_bytes,
                              const void *bytes, uint64_t count, fm_error *err);
fm_status vulkan_buffer_read(fm_device *device, fm_buffer *buffer, uint64_t offset_bytes,
                             void *bytes, uint64_t count, fm_error *err);
/* What is recorded into self->transfer_commands between the two runs after all that went before,
 * and is done when the second returns. */
fm_status vulkan_transfer_begin(vulkan *self, fm_error *err);
fm_status vulkan_transfer_end(vulkan *self, fm_error *err);
/* Ends the commands, submits them and waits, VULKAN_WAIT_NS at most on a GPU. `what` they are
 * stands first in messages. FM_DEVICE_LOST. */
fm_status vulkan_submit(vulkan *self, VkCommandBuffer commands, const char *what, fm_error *err);

/* image.c */
fm_status vulkan_image_create(fm_image_resource **image, fm_device *device,
                              const fm_image_desc *desc, fm_error *err);
void vulkan_image_destroy(fm_device *device, fm_image_resource *image);

/* shader.c. One stage to a module. Adds the SPIR-V to the pipeline's key.
 * counting  NULL: the shader stays as it is */
fm_status vulkan_shader_create(VkShaderModule *module, cache_key *key, vulkan *self,
                               const glsl_source *source, const spirv_counting *counting,
                               fm_error *err);

/* What the driver made of shaders before, by their SPIR-V and its build. Pipelines of the same
 * shaders that differ in state share a file, which grows by what the driver adds. */
typedef struct vulkan_pipelines {
    cache_key key;
    VkPipelineCache cache; /* to make the pipeline with; VK_NULL_HANDLE without a cache */
    void *bytes;           /* [count]: what was kept; owned */
    size_t count;
} vulkan_pipelines;
/* The shaders are still to be added. */
cache_key vulkan_pipeline_key(const vulkan *self);
void vulkan_pipelines_recall(vulkan_pipelines *kept, const vulkan *self, const cache_key *key);
/* Ends it, and keeps what the driver has now, if that is more. is_made: the pipeline was. */
void vulkan_pipelines_keep(vulkan_pipelines *kept, const vulkan *self, bool is_made);

/* state.c: fixed-function state. */
VkPipelineDepthStencilStateCreateInfo vulkan_depth_stencil(const fm_pipeline_desc *desc);
VkSampleMask vulkan_sample_mask(const fm_pipeline_desc *desc);
VkPipelineColorBlendAttachmentState vulkan_blend(const fm_target_desc *target);
VkFormat vulkan_vertex_format(const fm_vertex_attribute *attribute);

/* pipeline.c */
fm_status vulkan_pipeline_create(fm_pipeline **pipeline, fm_device *device,
                                 const fm_pipeline_desc *desc, fm_error *err);
void vulkan_pipeline_destroy(fm_device *device, fm_pipeline *pipeline);

/* barrier.c. Add what a command will do to its resources, then record. */
VkMemoryBarrier2 vulkan_barrier_begin(void);
void vulkan_barrier_add(VkMemoryBarrier2 *barrier, vulkan_access *access, uint64_t epoch,
                        VkPipelineStageFlags2 stages, VkAccessFlags2 accesses);
void vulkan_barrier_add_binds(VkMemoryBarrier2 *barrier, uint64_t epoch, const fm_bind *binds,
                              uint32_t count, VkPipelineStageFlags2 stages);
void vulkan_barrier_record(VkCommandBuffer commands, const VkMemoryBarrier2 *barrier);
/* Everything before is complete and visible to everything after; starts a new epoch. */
void vulkan_barrier_full(vulkan *self, VkCommandBuffer commands);

/* bind.c. Everything that shaders of a command see: buffers, textures, images, written into a
 * descriptor set that lasts until the next frame begins. FM_UNSUPPORTED: more than FM_MAX_BINDINGS,
 * or an image that shaders cannot store into. */
fm_status vulkan_bind(vulkan *self, const fm_pipeline *pipeline, const fm_bind *binds,
                      uint32_t count, fm_error *err);
/* Takes all sets back. */
fm_status vulkan_bind_reset(vulkan *self, fm_error *err);
void vulkan_bind_destroy(vulkan *self);

/* frame.c */
fm_status vulkan_queries_create(vulkan *self, fm_error *err);
void vulkan_queries_destroy(vulkan *self);
fm_status vulkan_frame_begin(fm_device *device, fm_error *err);
fm_status vulkan_frame_end(fm_device *device, fm_frame_times *times, fm_error *err);
void vulkan_timer_begin(fm_device *device, uint32_t timer);
void vulkan_timer_end(fm_device *device, uint32_t timer);

/* command.c */
void vulkan_fill(fm_device *device, fm_buffer *buffer, uint32_t word);
void vulkan_update(fm_device *device, fm_buffer *buffer, uint64_t offset_bytes, const void *bytes,
                   uint32_t count);
void vulkan_image_clear(fm_device *device, fm_image_resource *image, const float colour[4],
                        float depth, uint32_t stencil);
fm_status vulkan_dispatch(fm_device *device, const fm_dispatch *dispatch, fm_error *err);

fm_status vulkan_draw(fm_device *device, const fm_draw *draw, fm_error *err);

#endif
