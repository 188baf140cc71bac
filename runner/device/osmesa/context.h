/* What the files of this folder share: the device's struct, its objects, and their functions. Files
 * that have one in vulkan/ with the same work have its name, too.
 *
 *   osmesa.c       the table of functions; list, open, close
 *   context.c      the OpenGL context, created and made current
 *   caps.c         what fm_device_caps says, and limits of its own
 *   gl.c           entry points and errors of OpenGL
 *   buffer.c       buffers, their reads and writes
 *   format.c       formats of images
 *   image.c        images
 *   shader.c       GLSL to a program
 *   pipeline.c     pipelines; state.c: fixed-function state from the interface's enums
 *   framebuffer.c  what draws attach, and clears
 *   frame.c        begin and end, timers and queries
 *   command.c      fill, update, clear, dispatch, draw; bind.c: what their shaders see
 *
 * There is no barrier.c: before every command everything waits for everything, since OpenGL orders
 * all but shader stores by itself and llvmpipe's threads share one memory. */
#ifndef FM_OSMESA_CONTEXT_H
#define FM_OSMESA_CONTEXT_H

#include "device/device.h"
#include "gl.h"

/* The context needs some window to be current; nothing is ever drawn into it. */
enum { OSMESA_WINDOW_PX = 4 };

struct fm_buffer {
    GLuint name;    /* owned */
    uint64_t bytes; /* as asked; the storage is rounded up to words, so that fill covers all */
    fm_owner owner;
};

struct fm_image_resource {
    GLuint name; /* of a texture; owned */
    fm_format format;
    uint32_t layers; /* 1 or more */
    bool is_array;
    uint64_t bytes; /* as booked */
    fm_owner owner;
};

/* OpenGL has no pipelines: a program, and the state that every draw sets anew. */
struct fm_pipeline {
    GLuint program;
    GLuint vertex_array; /* 0 for compute */
    fm_state state;      /* from here on as fm_pipeline_desc has it; samples: 1 or more */
    uint32_t iteration;
    fm_target_desc targets[FM_MAX_TARGETS];
    uint32_t target_count;
    uint32_t samples;
    uint32_t vertex_stride_bytes;
};

/* What the framebuffer of draws is made of now; all zero: nothing attached. Compared as bytes: its
 * members leave no padding. */
typedef struct osmesa_attachments {
    GLuint targets[FM_MAX_TARGETS];
    uint32_t target_count;
    GLuint depth_stencil;
    GLint width_px, height_px, samples; /* 0 unless nothing is attached */
} osmesa_attachments;

/* What bindings may be: numbers end before end[kind], a stage has per_stage[kind] at most. */
typedef struct osmesa_limits {
    GLint binding_end[FM_BINDING_STORAGE_IMAGE + 1];
    GLint per_stage[FM_BINDING_STORAGE_IMAGE + 1];
    GLint texture_px;    /* the largest side of an image */
    GLint uniform_bytes; /* of a block */
} osmesa_limits;

/* The device. What OpenGL made for it, but for buffers, images and pipelines, ends with its
 * context. */
typedef struct osmesa {
    fm_device base; /* first: a fm_device is cast to this */
    osmesa_library library;
    OSMesaContext context; /* current on the thread that called osmesa_current last */
    unsigned char window[OSMESA_WINDOW_PX * OSMESA_WINDOW_PX * 4];
    fm_gl gl; /* entry points */
    osmesa_limits limits;
    bool no_timers;

    GLuint draw_framebuffer;        /* of draws, which keep it from one to the next */
    GLuint clear_framebuffer;       /* of images that are cleared: attached for that alone */
    osmesa_attachments attachments; /* of draw_framebuffer */

    GLuint timestamps[2]; /* begin and end of the running timer */
    GLuint queries[FM_MAX_QUERIES];
    uint32_t queries_used;   /* bit i: queries[i] ran and was not read yet */
    fm_frame_times times;    /* of the running frame */
    uint64_t frame_start_ns; /* the host's clock at frame_begin */

    uint32_t validation_errors;       /* errors and undefined behaviour that OpenGL told of */
    char first_validation_error[512]; /* cut if need be */
} osmesa;

/* context.c. Creates self->context, makes it current and loads self->gl. FM_UNSUPPORTED: no
 * OpenGL 4.5 here, with how to get it. On failure osmesa_device.close releases what there is. */
fm_status osmesa_context_create(osmesa *self, fm_error *err);
/* The device as its own type, with its context current on this thread. */
osmesa *osmesa_current(fm_device *device);

/* caps.c. The context must be current. */
void osmesa_limits_find(osmesa_limits *limits, const fm_gl *gl);
void osmesa_caps_find(fm_device_caps *caps, const fm_gl *gl, const osmesa_library *library);

/* format.c. What OpenGL calls a format, and how images of it are attached and cleared. */
typedef struct osmesa_format {
    GLenum internal; /* GL_NONE for FM_FORMAT_NONE */
    bool is_integer, has_depth, has_stencil;
} osmesa_format;
const osmesa_format *osmesa_format_of(fm_format format);

/* buffer.c */
fm_status osmesa_buffer_create(fm_buffer **buffer, fm_device *device, const fm_buffer_desc *desc,
                               fm_error *err);
void osmesa_buffer_destroy(fm_device *device, fm_buffer *buffer);
uint64_t osmesa_buffer_address(const fm_buffer *buffer); /* 0: OpenGL has none */
fm_status osmesa_buffer_write(fm_device *device, fm_buffer *buffer, uint64_t offset_bytes,
                              const void *bytes, uint64_t count, fm_error *err);
fm_status osmesa_buffer_read(fm_device *device, fm_buffer *buffer, uint64_t offset_bytes,
                             void *bytes, uint64_t count, fm_error *err);

/* image.c */
fm_status osmesa_image_create(fm_image_resource **image, fm_device *device,
                              const fm_image_desc *desc, fm_error *err);
void osmesa_image_destroy(fm_device *device, fm_image_resource *image);

/* shader.c. Compiles and links the stages that desc has. The caller deletes *program, also on
 * failure. FM_SHADER; FM_UNSUPPORTED: it does not link because it binds more than a stage can have.
 */
fm_status osmesa_program_create(GLuint *program, const osmesa *self, const fm_pipeline_desc *desc,
                                fm_error *err);

/* pipeline.c */
fm_status osmesa_pipeline_create(fm_pipeline **pipeline, fm_device *device,
                                 const fm_pipeline_desc *desc, fm_error *err);
void osmesa_pipeline_destroy(fm_device *device, fm_pipeline *pipeline);

/* state.c. Sets every piece of fixed-function state that a draw of this pipeline depends on. */
void osmesa_state_apply(const fm_gl *gl, const fm_pipeline *pipeline);
/* Takes off the masks that would keep clears from pixels, channels or bits. */
void osmesa_state_allow_clears(const fm_gl *gl);

/* framebuffer.c. Binds the framebuffer of draws with what this draw attaches. It is kept from draw
 * to draw: passes of a loop find it ready. FM_UNSUPPORTED: the attachments do not fit together. */
fm_status osmesa_framebuffer_bind(osmesa *self, const fm_draw *draw, fm_error *err);
/* Clears those attachments of the bound framebuffer that the draw loads by a clear. */
void osmesa_framebuffer_clear(const fm_gl *gl, const fm_draw *draw);
/* Clears all layers of an image that need not be attached. */
void osmesa_framebuffer_clear_image(osmesa *self, const fm_image_resource *image,
                                    const float colour[4], float depth, uint32_t stencil);
/* To be called before a texture is deleted: its name may be given to the next one, which the
 * framebuffer must not seem to hold already. */
void osmesa_framebuffer_forget(osmesa *self, GLuint name);

/* bind.c. Everything that shaders of a command see: buffers, textures, images. */
void osmesa_bind(const fm_gl *gl, const fm_bind *binds, uint32_t count);
const char *osmesa_binding_kind_name(fm_binding_kind kind); /* "storage buffers" */

/* frame.c */
fm_status osmesa_frame_begin(fm_device *device, fm_error *err);
fm_status osmesa_frame_end(fm_device *device, fm_frame_times *times, fm_error *err);
void osmesa_timer_begin(fm_device *device, uint32_t timer);
void osmesa_timer_end(fm_device *device, uint32_t timer);
/* Adds what queries[slot] counted to the frame's times, if it ran since it was last read. */
void osmesa_query_collect(osmesa *self, uint32_t slot);

/* command.c */
void osmesa_fill(fm_device *device, fm_buffer *buffer, uint32_t word);
void osmesa_update(fm_device *device, fm_buffer *buffer, uint64_t offset_bytes, const void *bytes,
                   uint32_t count);
void osmesa_image_clear(fm_device *device, fm_image_resource *image, const float colour[4],
                        float depth, uint32_t stencil);
fm_status osmesa_dispatch(fm_device *device, const fm_dispatch *dispatch, fm_error *err);

fm_status osmesa_draw(fm_device *device, const fm_draw *draw, fm_error *err);

#endif
