#include "osmesa.h"

#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "context.h"

static fm_status list_devices(fm_device_entry *entries, size_t *count, fm_error *err)
{
    osmesa_library library;
    const size_t room = *count;
    *count = 0;
    const fm_status status = osmesa_library_open(&library, err);
    if (status != FM_OK)
        return status;
    dlclose(library.handle);
    if (room > 0) {
        snprintf(entries[0].selector, sizeof entries[0].selector, "osmesa");
        snprintf(entries[0].name, sizeof entries[0].name, "OpenGL by OSMesa (Mesa llvmpipe)");
        *count = 1;
    }
    return FM_OK;
}

static void GLAPIENTRY note_message(GLenum source, GLenum type, GLuint id, GLenum severity,
                                    GLsizei length, const GLchar *message, const void *user)
{
    osmesa *self = NULL;
    (void)source, (void)id, (void)severity, (void)length;
    if (type != GL_DEBUG_TYPE_ERROR && type != GL_DEBUG_TYPE_UNDEFINED_BEHAVIOR)
        return;
    memcpy(&self, &user, sizeof self); /* the const is OpenGL's; the object is ours */
    if (self->validation_errors++ == 0)
        snprintf(self->first_validation_error, sizeof self->first_validation_error, "%s", message);
}

/* State that stays for the life of the context. */
static void set_constant_state(osmesa *self, const fm_device_desc *desc)
{
    const fm_gl *gl = &self->gl;
    if (desc->validation) {
        gl->Enable(GL_DEBUG_OUTPUT);
        gl->Enable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
        gl->DebugMessageCallback(note_message, self);
    }
    /* Vulkan's coordinates. Into a framebuffer object, NDC y = -1 is row 0 by itself. */
    gl->ClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    gl->ProvokingVertex(GL_FIRST_VERTEX_CONVENTION);
    /* Without it llvmpipe gives all samples to the first fragment, and stencil routing fails. */
    gl->Enable(GL_MULTISAMPLE);
    gl->Disable(GL_DITHER);
    gl->CreateFramebuffers(1, &self->draw_framebuffer);
    gl->CreateFramebuffers(1, &self->clear_framebuffer);
    gl->CreateQueries(GL_TIMESTAMP, 2, self->timestamps);
    gl->CreateQueries(GL_SAMPLES_PASSED, FM_MAX_QUERIES, self->queries);
}

static void close_device(fm_device *device)
{
    if (device == NULL)
        return;
    osmesa *self = (osmesa *)device;
    if (self->context != NULL) /* its framebuffers and queries go with it */
        self->library.destroy_context(self->context);
    if (self->library.handle != NULL)
        dlclose(self->library.handle);
    free(self);
}

static fm_status open_device(fm_device **device, const fm_device_desc *desc, fm_error *err)
{
    fm_status status = FM_OK;
    *device = NULL;
    if (desc->selector != NULL && desc->selector[0] != '\0')
        return fm_fail(err, FM_INVALID, "osmesa:%s: there is one such device; write 'osmesa'",
                       desc->selector);
    osmesa *self = calloc(1, sizeof *self);
    if (self == NULL)
        return fm_fail(err, FM_NO_MEMORY, "osmesa: %zu bytes", sizeof *self);
    status = osmesa_context_create(self, err);
    if (status != FM_OK)
        goto out;
    self->base.ops = &osmesa_device;
    self->no_timers = desc->no_timers;
    osmesa_limits_find(&self->limits, &self->gl);
    osmesa_caps_find(&self->base.caps, &self->gl, &self->library);
    set_constant_state(self, desc);
    *device = &self->base;
    self = NULL;
out:
    close_device(self != NULL ? &self->base : NULL);
    return status;
}

static uint32_t validation_errors(const fm_device *device, const char **first)
{
    const osmesa *self = (const osmesa *)device;
    *first = self->first_validation_error;
    return self->validation_errors;
}

const fm_device_ops osmesa_device = {
    .name = "osmesa",
    .list = list_devices,
    .open = open_device,
    .close = close_device,
    .validation_errors = validation_errors,
    .buffer_create = osmesa_buffer_create,
    .buffer_destroy = osmesa_buffer_destroy,
    .buffer_address = osmesa_buffer_address,
    .buffer_write = osmesa_buffer_write,
    .buffer_read = osmesa_buffer_read,
    .image_create = osmesa_image_create,
    .image_destroy = osmesa_image_destroy,
    .pipeline_create = osmesa_pipeline_create,
    .pipeline_destroy = osmesa_pipeline_destroy,
    .frame_begin = osmesa_frame_begin,
    .frame_end = osmesa_frame_end,
    .timer_begin = osmesa_timer_begin,
    .timer_end = osmesa_timer_end,
    .fill = osmesa_fill,
    .update = osmesa_update,
    .image_clear = osmesa_image_clear,
    .dispatch = osmesa_dispatch,
    .draw = osmesa_draw,
};
