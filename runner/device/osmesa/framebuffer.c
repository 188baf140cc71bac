#include <string.h>

#include "context.h"

/* Of an array this layer alone, else all there is. */
static void attach(const fm_gl *gl, GLuint framebuffer, GLenum point,
                   const fm_image_resource *image, uint32_t layer)
{
    if (image->is_array)
        gl->NamedFramebufferTextureLayer(framebuffer, point, image->name, 0, (GLint)layer);
    else
        gl->NamedFramebufferTexture(framebuffer, point, image->name, 0);
}

static GLenum depth_attachment(const fm_image_resource *image)
{
    return osmesa_format_of(image->format)->has_stencil ? GL_DEPTH_STENCIL_ATTACHMENT
                                                        : GL_DEPTH_ATTACHMENT;
}

static osmesa_attachments attachments_of(const fm_draw *draw)
{
    osmesa_attachments wanted = { .target_count = draw->target_count };
    for (uint32_t i = 0; i < draw->target_count; i++)
        wanted.targets[i] = draw->targets[i]->name;
    if (draw->depth_stencil != NULL)
        wanted.depth_stencil = draw->depth_stencil->name;
    if (draw->target_count == 0 && draw->depth_stencil == NULL) {
        wanted.width_px = (GLint)draw->width_px;
        wanted.height_px = (GLint)draw->height_px;
        wanted.samples = draw->pipeline->samples > 1 ? (GLint)draw->pipeline->samples : 0;
    }
    return wanted;
}

static void attach_all(const fm_gl *gl, GLuint framebuffer, const osmesa_attachments *old,
                       const fm_draw *draw, const osmesa_attachments *wanted)
{
    GLenum points[FM_MAX_TARGETS];
    for (uint32_t i = 0; i < draw->target_count; i++) {
        points[i] = GL_COLOR_ATTACHMENT0 + i;
        attach(gl, framebuffer, points[i], draw->targets[i], 0); /* draws see layer 0 alone */
    }
    for (uint32_t i = draw->target_count; i < old->target_count; i++)
        gl->NamedFramebufferTexture(framebuffer, GL_COLOR_ATTACHMENT0 + i, 0, 0);
    gl->NamedFramebufferDrawBuffers(framebuffer, (GLsizei)draw->target_count, points);
    if (old->depth_stencil != wanted->depth_stencil)
        gl->NamedFramebufferTexture(framebuffer, GL_DEPTH_STENCIL_ATTACHMENT, 0, 0);
    if (draw->depth_stencil != NULL)
        attach(gl, framebuffer, depth_attachment(draw->depth_stencil), draw->depth_stencil, 0);
    gl->NamedFramebufferParameteri(framebuffer, GL_FRAMEBUFFER_DEFAULT_WIDTH, wanted->width_px);
    gl->NamedFramebufferParameteri(framebuffer, GL_FRAMEBUFFER_DEFAULT_HEIGHT, wanted->height_px);
    gl->NamedFramebufferParameteri(framebuffer, GL_FRAMEBUFFER_DEFAULT_SAMPLES, wanted->samples);
}

static const char *incomplete_reason(GLenum reason)
{
    switch (reason) {
    case GL_FRAMEBUFFER_INCOMPLETE_ATTACHMENT:
        return "an attachment cannot be drawn into";
    case GL_FRAMEBUFFER_INCOMPLETE_MULTISAMPLE:
        return "attachments differ in their samples";
    case GL_FRAMEBUFFER_UNSUPPORTED:
        return "this combination of formats is not supported";
    default:
        return "the framebuffer is incomplete";
    }
}

/* The framebuffer of draws anew, with nothing attached. */
static void reset(osmesa *self)
{
    self->gl.DeleteFramebuffers(1, &self->draw_framebuffer);
    self->gl.CreateFramebuffers(1, &self->draw_framebuffer);
    self->attachments = (osmesa_attachments){ .target_count = 0 };
}

/* The framebuffer of the last draw is kept: passes of a loop find it ready. */
fm_status osmesa_framebuffer_bind(osmesa *self, const fm_draw *draw, fm_error *err)
{
    const fm_gl *gl = &self->gl;
    const osmesa_attachments wanted = attachments_of(draw);
    if (memcmp(&wanted, &self->attachments, sizeof wanted) != 0) {
        attach_all(gl, self->draw_framebuffer, &self->attachments, draw, &wanted);
        self->attachments = wanted;
        const GLenum reason =
            gl->CheckNamedFramebufferStatus(self->draw_framebuffer, GL_DRAW_FRAMEBUFFER);
        if (reason != GL_FRAMEBUFFER_COMPLETE) {
            reset(self); /* or the next such draw would go unchecked */
            return fm_refuse(err, FM_REASON_FEATURE, "draw: %s", incomplete_reason(reason));
        }
    }
    gl->BindFramebuffer(GL_DRAW_FRAMEBUFFER, self->draw_framebuffer);
    return FM_OK;
}

void osmesa_framebuffer_forget(osmesa *self, GLuint name)
{
    bool is_attached = self->attachments.depth_stencil == name;
    for (uint32_t i = 0; i < self->attachments.target_count; i++)
        is_attached = is_attached || self->attachments.targets[i] == name;
    if (is_attached)
        reset(self);
}

static void clear_colour(const fm_gl *gl, GLint index, const fm_image_resource *image,
                         const float colour[4])
{
    GLuint bits[4];
    if (!osmesa_format_of(image->format)->is_integer) {
        gl->ClearBufferfv(GL_COLOR, index, colour);
        return;
    }
    memcpy(bits, colour, sizeof bits);
    gl->ClearBufferuiv(GL_COLOR, index, bits);
}

static void clear_depth_stencil(const fm_gl *gl, const fm_image_resource *image, float depth,
                                uint32_t stencil)
{
    if (osmesa_format_of(image->format)->has_stencil)
        gl->ClearBufferfi(GL_DEPTH_STENCIL, 0, depth, (GLint)stencil);
    else
        gl->ClearBufferfv(GL_DEPTH, 0, &depth);
}

void osmesa_framebuffer_clear(const fm_gl *gl, const fm_draw *draw)
{
    osmesa_state_allow_clears(gl);
    for (uint32_t i = 0; i < draw->target_count; i++) {
        if (draw->target_loads[i] == FM_LOAD_CLEAR)
            clear_colour(gl, (GLint)i, draw->targets[i], draw->target_clears[i]);
    }
    if (draw->depth_stencil != NULL && draw->depth_stencil_load == FM_LOAD_CLEAR)
        clear_depth_stencil(gl, draw->depth_stencil, draw->clear_depth, draw->clear_stencil);
}

void osmesa_framebuffer_clear_image(osmesa *self, const fm_image_resource *image,
                                    const float colour[4], float depth, uint32_t stencil)
{
    const fm_gl *gl = &self->gl;
    const bool has_depth = osmesa_format_of(image->format)->has_depth;
    const GLenum point = has_depth ? depth_attachment(image) : GL_COLOR_ATTACHMENT0;
    gl->BindFramebuffer(GL_DRAW_FRAMEBUFFER, self->clear_framebuffer);
    gl->Disable(GL_SCISSOR_TEST);
    osmesa_state_allow_clears(gl);
    for (uint32_t layer = 0; layer < image->layers; layer++) {
        attach(gl, self->clear_framebuffer, point, image, layer);
        if (has_depth)
            clear_depth_stencil(gl, image, depth, stencil);
        else
            clear_colour(gl, 0, image, colour);
    }
    gl->NamedFramebufferTexture(self->clear_framebuffer, point, 0, 0);
}
