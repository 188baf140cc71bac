#include <assert.h>
#include <stdlib.h>

#include "context.h"
#include "device/ledger.h"

static unsigned long long mebibytes(uint64_t bytes)
{
    return bytes / (1024u * 1024u) + (bytes % (1024u * 1024u) != 0);
}

static fm_status check_buffer(const osmesa *self, const fm_buffer_desc *desc, fm_error *err)
{
    const uint64_t range = self->base.caps.storage_range_bytes;
    assert(desc->bytes > 0);
    if (desc->by_address)
        return fm_refuse(err, FM_REASON_FEATURE, "buffer '%s': OpenGL has no buffer addresses",
                         desc->name);
    if (desc->bytes > range)
        return fm_refuse(err, FM_REASON_DEVICE_LIMIT,
                         "buffer '%s': %llu MiB, bound buffers of this device end at %llu MiB",
                         desc->name, mebibytes(desc->bytes), mebibytes(range));
    if (desc->is_uniform && desc->bytes > (uint64_t)self->limits.uniform_bytes)
        return fm_refuse(err, FM_REASON_DEVICE_LIMIT,
                         "buffer '%s': %llu bytes, uniform buffers of this device end at %d",
                         desc->name, (unsigned long long)desc->bytes, self->limits.uniform_bytes);
    return FM_OK;
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
    status = gl_check_storage(&self->gl, "buffer", desc->name, desc->bytes, err);
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
