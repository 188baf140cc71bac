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

/* Coordinates are Vulkan's: see set_constant_state in osmesa.c. */
static void set_area(const fm_gl *gl, const fm_draw *draw)
{
    const GLsizei width = (GLsizei)draw->width_px, height = (GLsizei)draw->height_px;
    gl->Viewport(0, 0, width, height);
    gl->Enable(GL_SCISSOR_TEST);
    gl->Scissor(0, 0, width, height);
}

static void issue(const fm_gl *gl, const fm_draw *draw)
{
    const fm_pipeline *pipeline = draw->pipeline;
    const GLsizei count = (GLsizei)draw->vertex_count;
    const GLsizei instances = (GLsizei)draw->instance_count;
    gl->BindVertexArray(pipeline->vertex_array);
    if (draw->vertices != NULL)
        gl->VertexArrayVertexBuffer(pipeline->vertex_array, 0, draw->vertices->name, 0,
                                    (GLsizei)pipeline->vertex_stride_bytes);
    if (draw->indices != NULL) {
        gl->VertexArrayElementBuffer(pipeline->vertex_array, draw->indices->name);
        gl->DrawElementsInstanced(GL_TRIANGLES, count, GL_UNSIGNED_INT, NULL, instances);
    } else {
        gl->DrawArraysInstanced(GL_TRIANGLES, 0, count, instances);
    }
}

static void begin_query(osmesa *self, uint32_t slot)
{
    assert(slot < FM_MAX_QUERIES);
    osmesa_query_collect(self, slot); /* of an earlier draw of this frame */
    self->queries_used |= 1u << slot;
    self->gl.BeginQuery(GL_SAMPLES_PASSED, self->queries[slot]);
}

fm_status osmesa_draw(fm_device *device, const fm_draw *draw, fm_error *err)
{
    osmesa *self = osmesa_current(device);
    const fm_gl *gl = &self->gl;
    if (draw->vertex_count > INT32_MAX || draw->instance_count > INT32_MAX)
        return fm_refuse(err, FM_REASON_DEVICE_LIMIT,
                         "draw: %u vertices, %u instances, OpenGL ends at %d", draw->vertex_count,
                         draw->instance_count, INT32_MAX);
    gl->MemoryBarrier(GL_ALL_BARRIER_BITS);
    const fm_status status = osmesa_framebuffer_bind(self, draw, err);
    if (status != FM_OK)
        return status;
    set_area(gl, draw);
    osmesa_framebuffer_clear(gl, draw);
    gl->UseProgram(draw->pipeline->program);
    osmesa_state_apply(gl, draw->pipeline);
    osmesa_bind(gl, draw->binds, draw->bind_count);
    if (draw->query >= 0)
        begin_query(self, (uint32_t)draw->query);
    issue(gl, draw);
    if (draw->query >= 0)
        gl->EndQuery(GL_SAMPLES_PASSED);
    return FM_OK;
}
