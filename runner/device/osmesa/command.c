#include <assert.h>

#include "context.h"
#include "device/dispatch.h"

void osmesa_fill(fm_device *device, fm_buffer *buffer, uint32_t word)
{
    const fm_gl *gl = &osmesa_current(device)->gl;
    gl->MemoryBarrier(GL_ALL_BARRIER_BITS);
    gl->ClearNamedBufferData(buffer->name, GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, &word);
}

void osmesa_update(fm_device *device, fm_buffer *buffer, uint64_t offset_bytes, const void *bytes,
                   uint32_t count)
{
    const fm_gl *gl = &osmesa_current(device)->gl;
    assert(offset_bytes <= buffer->bytes && count <= buffer->bytes - offset_bytes);
    gl->MemoryBarrier(GL_ALL_BARRIER_BITS);
    gl->NamedBufferSubData(buffer->name, (GLintptr)offset_bytes, (GLsizeiptr)count, bytes);
}

void osmesa_image_clear(fm_device *device, fm_image_resource *image, const float colour[4],
                        float depth, uint32_t stencil)
{
    osmesa *self = osmesa_current(device);
    self->gl.MemoryBarrier(GL_ALL_BARRIER_BITS);
    osmesa_framebuffer_clear_image(self, image, colour, depth, stencil);
}

fm_status osmesa_dispatch(fm_device *device, const fm_dispatch *dispatch, fm_error *err)
{
    const fm_gl *gl = &osmesa_current(device)->gl;
    const fm_status status = dispatch_check_groups(device, dispatch, err);
    if (status != FM_OK)
        return status;
    gl->MemoryBarrier(GL_ALL_BARRIER_BITS);
    gl->UseProgram(dispatch->pipeline->program);
    osmesa_bind(gl, dispatch->binds, dispatch->bind_count);
    if (dispatch->indirect != NULL) {
        gl->BindBuffer(GL_DISPATCH_INDIRECT_BUFFER, dispatch->indirect->name);
        gl->DispatchComputeIndirect(0);
    } else {
        gl->DispatchCompute(dispatch->groups[0], dispatch->groups[1], dispatch->groups[2]);
    }
    return FM_OK;
}
