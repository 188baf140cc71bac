#include <assert.h>
#include <stdlib.h>

#include "context.h"
#include "device/ledger.h"
#include "model/formats.h"

static uint64_t bytes_of(const fm_image_desc *desc, uint32_t layers, uint32_t samples)
{
    return (uint64_t)desc->width_px * desc->height_px * layers * samples *
           format_bytes(desc->format);
}

static fm_status check_image(const osmesa *self, const fm_image_desc *desc, uint32_t layers,
                             uint32_t samples, fm_error *err)
{
    const uint32_t side = (uint32_t)self->limits.texture_px;
    const uint32_t possible = osmesa_format_of(desc->format)->has_depth
                                  ? self->base.caps.depth_samples
                                  : self->base.caps.colour_samples;
    assert(desc->format != FM_FORMAT_NONE && desc->width_px > 0 && desc->height_px > 0);
    if (desc->width_px > side || desc->height_px > side)
        return fm_refuse(err, FM_REASON_DEVICE_LIMIT,
                         "image '%s': %u x %u px, images of this device end at %u px", desc->name,
                         desc->width_px, desc->height_px, side);
    if (layers > self->base.caps.image_layers)
        return fm_refuse(err, FM_REASON_DEVICE_LIMIT,
                         "image '%s': %u layers, images of this device end at %u", desc->name,
                         layers, self->base.caps.image_layers);
    if (samples >= 32 || (possible >> samples & 1u) == 0)
        return fm_refuse(err, FM_REASON_DEVICE_LIMIT,
                         "image '%s': %u samples are not possible on this device", desc->name,
                         samples);
    if (bytes_of(desc, layers, samples) > self->base.caps.image_max_bytes)
        return fm_refuse(err, FM_REASON_DEVICE_LIMIT,
                         "image '%s': %llu bytes, images of this device end at %llu", desc->name,
                         (unsigned long long)bytes_of(desc, layers, samples),
                         (unsigned long long)self->base.caps.image_max_bytes);
    return FM_OK;
}

/* What the sampler types of the shaders must be. */
static void create_texture(fm_image_resource *image, const fm_gl *gl, const fm_image_desc *desc,
                           uint32_t samples)
{
    const GLenum format = osmesa_format_of(desc->format)->internal;
    const GLsizei width = (GLsizei)desc->width_px, height = (GLsizei)desc->height_px;
    const GLsizei layers = (GLsizei)image->layers;
    if (samples > 1 && image->is_array) {
        gl->CreateTextures(GL_TEXTURE_2D_MULTISAMPLE_ARRAY, 1, &image->name);
        gl->TextureStorage3DMultisample(image->name, (GLsizei)samples, format, width, height,
                                        layers, GL_TRUE);
    } else if (samples > 1) {
        gl->CreateTextures(GL_TEXTURE_2D_MULTISAMPLE, 1, &image->name);
        gl->TextureStorage2DMultisample(image->name, (GLsizei)samples, format, width, height,
                                        GL_TRUE);
    } else if (image->is_array) {
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
    made->is_array = layers > 1 || desc->is_array;
    made->bytes = bytes_of(desc, layers, samples);
    create_texture(made, &self->gl, desc, samples);
    status = gl_check_storage(&self->gl, "image", desc->name, made->bytes, err);
    if (status != FM_OK) {
        self->gl.DeleteTextures(1, &made->name);
        free(made);
        return status;
    }
    ledger_add(&device->ledger, made->owner, made->bytes);
    *image = made;
    return FM_OK;
}

void osmesa_image_destroy(fm_device *device, fm_image_resource *image)
{
    if (image == NULL)
        return;
    osmesa *self = osmesa_current(device);
    osmesa_framebuffer_forget(self, image->name);
    self->gl.DeleteTextures(1, &image->name);
    ledger_remove(&device->ledger, image->owner, image->bytes);
    free(image);
}
