#include <assert.h>
#include <stdlib.h>

#include "context.h"
#include "model/formats.h"

static const osmesa_format formats[] = {
    [FM_FORMAT_NONE] = { .internal = GL_NONE },
    [FM_FORMAT_R32UI] = { .internal = GL_R32UI, .is_integer = true },
    [FM_FORMAT_RG32UI] = { .internal = GL_RG32UI, .is_integer = true },
    [FM_FORMAT_RGBA32UI] = { .internal = GL_RGBA32UI, .is_integer = true },
    [FM_FORMAT_R32F] = { .internal = GL_R32F },
    [FM_FORMAT_RG32F] = { .internal = GL_RG32F },
    [FM_FORMAT_RGBA32F] = { .internal = GL_RGBA32F },
    [FM_FORMAT_RGBA8] = { .internal = GL_RGBA8 },
    [FM_FORMAT_D32F] = { .internal = GL_DEPTH_COMPONENT32F, .has_depth = true },
    [FM_FORMAT_D32F_S8] = { .internal = GL_DEPTH32F_STENCIL8,
                            .has_depth = true,
                            .has_stencil = true },
};
_Static_assert(sizeof formats / sizeof formats[0] == FM_FORMAT_COUNT, "one a format");

const osmesa_format *osmesa_format_of(fm_format format)
{
    return &formats[format];
}

static unsigned long long mebibytes(uint64_t bytes)
{
    return bytes / (1024u * 1024u) + (bytes % (1024u * 1024u) != 0);
}

static fm_status check_buffer(const osmesa *self, const fm_buffer_desc *desc, fm_error *err)
{
    const uint64_t range = self->base.caps.storage_range_bytes;
    assert(desc->bytes > 0);
    if (desc->by_address)
        return fm_fail(err, FM_UNSUPPORTED, "buffer '%s': OpenGL has no buffer addresses",
                       desc->name);
    if (desc->bytes > range)
        return fm_fail(err, FM_UNSUPPORTED,
                       "buffer '%s': %llu MiB, bound buffers of this device end at %llu MiB",
                       desc->name, mebibytes(desc->bytes), mebibytes(range));
    if (desc->is_uniform && desc->bytes > (uint64_t)self->limits.uniform_bytes)
        return fm_fail(err, FM_UNSUPPORTED,
                       "buffer '%s': %llu bytes, uniform buffers of this device end at %d",
                       desc->name, (unsigned long long)desc->bytes, self->limits.uniform_bytes);
    return FM_OK;
}

/* What came of asking OpenGL for the storage of "buffer" or "image" NAME. */
static fm_status check_storage(const fm_gl *gl, const char *kind, const char *name, uint64_t bytes,
                               fm_error *err)
{
    const GLenum code = gl->GetError();
    if (code == GL_NO_ERROR)
        return FM_OK;
    if (code == GL_OUT_OF_MEMORY)
        return fm_fail(err, FM_NO_MEMORY, "%s '%s': no room for %llu bytes", kind, name,
                       (unsigned long long)bytes);
    return fm_fail(err, FM_DEVICE_LOST, "%s '%s': %s", kind, name, gl_error_name(code));
}

fm_status osmesa_buffer_create(fm_buffer **buffer, fm_device *device, const fm_buffer_desc *desc,
                               fm_error *err)
{
    osmesa *self = osmesa_current(device);
    *buffer = NULL;
    fm_status status = check_buffer(self, desc, err);
    if (status != FM_OK)
        return status;
    fm_buffer *made = calloc(1, sizeof *made);
    if (made == NULL)
        return fm_fail(err, FM_NO_MEMORY, "buffer '%s': its handle", desc->name);
    self->gl.CreateBuffers(1, &made->name);
    self->gl.NamedBufferStorage(made->name, (GLsizeiptr)((desc->bytes + 3) / 4 * 4), NULL,
                                GL_DYNAMIC_STORAGE_BIT);
    status = check_storage(&self->gl, "buffer", desc->name, desc->bytes, err);
    if (status != FM_OK) {
        self->gl.DeleteBuffers(1, &made->name);
        free(made);
        return status;
    }
    made->bytes = desc->bytes;
    made->owner = desc->owner;
    ledger_add(&device->ledger, made->owner, made->bytes);
    *buffer = made;
    return FM_OK;
}

void osmesa_buffer_destroy(fm_device *device, fm_buffer *buffer)
{
    if (buffer == NULL)
        return;
    osmesa_current(device)->gl.DeleteBuffers(1, &buffer->name);
    ledger_remove(&device->ledger, buffer->owner, buffer->bytes);
    free(buffer);
}

uint64_t osmesa_buffer_address(const fm_buffer *buffer)
{
    (void)buffer;
    return 0;
}

/* An error here is left over from an earlier command or is the transfer's own. */
static fm_status check_transfer(const fm_gl *gl, const char *what, fm_error *err)
{
    const GLenum code = gl->GetError();
    if (code == GL_NO_ERROR)
        return FM_OK;
    return fm_fail(err, FM_DEVICE_LOST, "osmesa: %s: %s", what, gl_error_name(code));
}

fm_status osmesa_buffer_write(fm_device *device, fm_buffer *buffer, uint64_t offset_bytes,
                              const void *bytes, uint64_t count, fm_error *err)
{
    const fm_gl *gl = &osmesa_current(device)->gl;
    assert(offset_bytes <= buffer->bytes && count <= buffer->bytes - offset_bytes);
    if (count > 0)
        gl->NamedBufferSubData(buffer->name, (GLintptr)offset_bytes, (GLsizeiptr)count, bytes);
    return check_transfer(gl, "writing a buffer", err);
}

fm_status osmesa_buffer_read(fm_device *device, fm_buffer *buffer, uint64_t offset_bytes,
                             void *bytes, uint64_t count, fm_error *err)
{
    const fm_gl *gl = &osmesa_current(device)->gl;
    assert(offset_bytes <= buffer->bytes && count <= buffer->bytes - offset_bytes);
    if (count > 0)
        gl->GetNamedBufferSubData(buffer->name, (GLintptr)offset_bytes, (GLsizeiptr)count, bytes);
    return check_transfer(gl, "reading a buffer", err);
}

static fm_status check_image(const osmesa *self, const fm_image_desc *desc, uint32_t layers,
                             uint32_t samples, fm_error *err)
{
    const uint32_t side = (uint32_t)self->limits.texture_px;
    const uint32_t possible = formats[desc->format].has_depth ? self->base.caps.depth_samples
                                                              : self->base.caps.colour_samples;
    assert(desc->format != FM_FORMAT_NONE && desc->width_px > 0 && desc->height_px > 0);
    if (desc->width_px > side || desc->height_px > side)
        return fm_fail(err, FM_UNSUPPORTED,
                       "image '%s': %u x %u px, images of this device end at %u px", desc->name,
                       desc->width_px, desc->height_px, side);
    if (layers > (uint32_t)self->limits.texture_layers)
        return fm_fail(err, FM_UNSUPPORTED,
                       "image '%s': %u layers, images of this device end at %d", desc->name, layers,
                       self->limits.texture_layers);
    if (samples >= 32 || (possible >> samples & 1u) == 0)
        return fm_fail(err, FM_UNSUPPORTED,
                       "image '%s': %u samples are not possible on this device", desc->name,
                       samples);
    return FM_OK;
}

/* layers > 1 make an array, samples > 1 a multisample texture: what the sampler types of the
 * shaders must be. */
static void create_texture(fm_image_resource *image, const fm_gl *gl, const fm_image_desc *desc,
                           uint32_t samples)
{
    const GLenum format = formats[desc->format].internal;
    const GLsizei width = (GLsizei)desc->width_px, height = (GLsizei)desc->height_px;
    const GLsizei layers = (GLsizei)image->layers;
    if (samples > 1 && layers > 1) {
        gl->CreateTextures(GL_TEXTURE_2D_MULTISAMPLE_ARRAY, 1, &image->name);
        gl->TextureStorage3DMultisample(image->name, (GLsizei)samples, format, width, height,
                                        layers, GL_TRUE);
    } else if (samples > 1) {
        gl->CreateTextures(GL_TEXTURE_2D_MULTISAMPLE, 1, &image->name);
        gl->TextureStorage2DMultisample(image->name, (GLsizei)samples, format, width, height,
                                        GL_TRUE);
    } else if (layers > 1) {
        gl->CreateTextures(GL_TEXTURE_2D_ARRAY, 1, &image->name);
        gl->TextureStorage3D(image->name, 1, format, width, height, layers);
    } else {
        gl->CreateTextures(GL_TEXTURE_2D, 1, &image->name);
        gl->TextureStorage2D(image->name, 1, format, width, height);
    }
    if (samples == 1) { /* integer textures are complete with these filters only */
        gl->TextureParameteri(image->name, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
        gl->TextureParameteri(image->name, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    }
}

fm_status osmesa_image_create(fm_image_resource **image, fm_device *device,
                              const fm_image_desc *desc, fm_error *err)
{
    osmesa *self = osmesa_current(device);
    const uint32_t layers = desc->layers == 0 ? 1 : desc->layers;
    const uint32_t samples = desc->samples == 0 ? 1 : desc->samples;
    *image = NULL;
    fm_status status = check_image(self, desc, layers, samples, err);
    if (status != FM_OK)
        return status;
    fm_image_resource *made = calloc(1, sizeof *made);
    if (made == NULL)
        return fm_fail(err, FM_NO_MEMORY, "image '%s': its handle", desc->name);
    made->format = desc->format;
    made->layers = layers;
    made->owner = desc->owner;
    made->bytes =
        (uint64_t)desc->width_px * desc->height_px * layers * samples * format_bytes(desc->format);
    create_texture(made, &self->gl, desc, samples);
    status = check_storage(&self->gl, "image", desc->name, made->bytes, err);
    if (status != FM_OK) {
        self->gl.DeleteTextures(1, &made->name);
        free(made);
        return status;
    }
    ledger_add(&device->ledger, made->owner, made->bytes);
    *image = made;
    return FM_OK;
}

/* A texture's name may be given to the next one: the framebuffer must not seem to hold it. */
static void forget_attachment(osmesa *self, GLuint name)
{
    bool is_attached = self->attachments.depth_stencil == name;
    for (uint32_t i = 0; i < self->attachments.target_count; i++)
        is_attached = is_attached || self->attachments.targets[i] == name;
    if (is_attached)
        osmesa_framebuffer_reset(self);
}

void osmesa_image_destroy(fm_device *device, fm_image_resource *image)
{
    if (image == NULL)
        return;
    osmesa *self = osmesa_current(device);
    forget_attachment(self, image->name);
    self->gl.DeleteTextures(1, &image->name);
    ledger_remove(&device->ledger, image->owner, image->bytes);
    free(image);
}
