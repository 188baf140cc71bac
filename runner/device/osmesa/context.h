/* What the files of the OpenGL device share: its struct, its objects, and their functions.
 *
 * osmesa.c opens and closes the device and says what it can; resource.c makes buffers and images;
 * pipeline.c compiles; state.c turns fm_state into OpenGL calls; frame.c executes commands. */
#ifndef FM_OSMESA_CONTEXT_H
#define FM_OSMESA_CONTEXT_H

#include "device/device.h"
#include "gl.h"

/* The context needs some window to be current; nothing is ever drawn into it. */
enum { OSMESA_WINDOW_PX = 4 };

struct fm_buffer {
    GLuint name;
    uint64_t bytes; /* as asked; the storage is rounded up to words, so that fill covers all */
    fm_owner owner;
};

struct fm_image_resource {
    GLuint name;
    fm_format format;
    uint32_t layers;
    uint64_t bytes;
    fm_owner owner;
};

struct fm_pipeline {
    GLuint program;
    GLuint vertex_array; /* 0 for compute */
    fm_state state;
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
    GLint texture_px, texture_layers, uniform_bytes;
} osmesa_limits;

typedef struct osmesa {
    fm_device base;
    OSMesaContext context;
    unsigned char window[OSMESA_WINDOW_PX * OSMESA_WINDOW_PX * 4];
    fm_gl gl;
    osmesa_limits limits;
    bool no_timers;

    GLuint draw_framebuffer, clear_framebuffer;
    osmesa_attachments attachments; /* of draw_framebuffer */

    GLuint timestamps[2]; /* begin and end of the running timer */
    GLuint queries[FM_MAX_QUERIES];
    uint32_t queries_used; /* bit i: queries[i] ran and was not read yet */
    fm_frame_times times;  /* of the running frame */
    uint64_t frame_start_ns;

    uint32_t validation_errors;
    char first_validation_error[512];
} osmesa;

/* The device as its own type, with its context current on this thread. */
osmesa *osmesa_current(fm_device *device);

/* Internal format of a texture; is_integer tells how it is cleared. */
typedef struct osmesa_format {
    GLenum internal;
    bool is_integer, has_depth, has_stencil;
} osmesa_format;
const osmesa_format *osmesa_format_of(fm_format format);

fm_status osmesa_buffer_create(fm_buffer **buffer, fm_device *device, const fm_buffer_desc *desc,
                               fm_error *err);
void osmesa_buffer_destroy(fm_device *device, fm_buffer *buffer);
uint64_t osmesa_buffer_address(const fm_buffer *buffer);
fm_status osmesa_buffer_write(fm_device *device, fm_buffer *buffer, uint64_t offset_bytes,
                              const void *bytes, uint64_t count, fm_error *err);
fm_status osmesa_buffer_read(fm_device *device, fm_buffer *buffer, uint64_t offset_bytes,
                             void *bytes, uint64_t count, fm_error *err);
fm_status osmesa_image_create(fm_image_resource **image, fm_device *device,
                              const fm_image_desc *desc, fm_error *err);
void osmesa_image_destroy(fm_device *device, fm_image_resource *image);

fm_status osmesa_pipeline_create(fm_pipeline **pipeline, fm_device *device,
                                 const fm_pipeline_desc *desc, fm_error *err);
void osmesa_pipeline_destroy(fm_device *device, fm_pipeline *pipeline);

/* Sets every piece of fixed-function state that a draw of this pipeline depends on. */
void osmesa_state_apply(const fm_gl *gl, const fm_pipeline *pipeline);
/* Undoes what of it limits clears: masks. */
void osmesa_state_allow_clears(const fm_gl *gl);

fm_status osmesa_frame_begin(fm_device *device, fm_error *err);
fm_status osmesa_frame_end(fm_device *device, fm_frame_times *times, fm_error *err);
void osmesa_timer_begin(fm_device *device, uint32_t timer);
void osmesa_timer_end(fm_device *device, uint32_t timer);
void osmesa_fill(fm_device *device, fm_buffer *buffer, uint32_t word);
void osmesa_update(fm_device *device, fm_buffer *buffer, uint64_t offset_bytes, const void *bytes,
                   uint32_t count);
fm_status osmesa_dispatch(fm_device *device, const fm_dispatch *dispatch, fm_error *err);
/* Adds what queries[slot] counted to the frame's times, if it ran since it was last read. */
void osmesa_query_collect(osmesa *self, uint32_t slot);
/* Everything that shaders of a command see: buffers, textures, images. */
void osmesa_bind(const fm_gl *gl, const fm_bind *binds, uint32_t count);

void osmesa_image_clear(fm_device *device, fm_image_resource *image, const float colour[4],
                        float depth, uint32_t stencil);
/* Makes the framebuffer of draws anew, with nothing attached. */
void osmesa_framebuffer_reset(osmesa *self);
fm_status osmesa_draw(fm_device *device, const fm_draw *draw, fm_error *err);

#endif
