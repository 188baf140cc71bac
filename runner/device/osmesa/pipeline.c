#include <assert.h>
#include <stdlib.h>
#include <string.h>

#include "context.h"

/* Numbers are unique across kinds for Vulkan's sake; each OpenGL kind has a name space and an end
 * of its own. */
static fm_status check_bindings(const osmesa *self, const fm_pipeline_desc *desc, fm_error *err)
{
    for (uint32_t i = 0; i < desc->binding_count; i++) {
        const fm_pipeline_binding *binding = &desc->bindings[i];
        assert(binding->kind != FM_BINDING_ADDRESS);
        if (binding->binding >= (uint32_t)self->limits.binding_end[binding->kind])
            return fm_refuse(err, FM_REASON_DEVICE_LIMIT,
                             "%s: binding %u, %s of this device end before binding %d", desc->name,
                             binding->binding, osmesa_binding_kind_name(binding->kind),
                             self->limits.binding_end[binding->kind]);
    }
    return FM_OK;
}

static const struct {
    GLint components;
    bool is_integer;
} element_layout[] = {
    [FM_ELEMENT_UINT] = { 1, true },   [FM_ELEMENT_UVEC2] = { 2, true },
    [FM_ELEMENT_UVEC4] = { 4, true },  [FM_ELEMENT_FLOAT] = { 1, false },
    [FM_ELEMENT_VEC2] = { 2, false },  [FM_ELEMENT_VEC4] = { 4, false },
    [FM_ELEMENT_UINT64] = { 2, true },
};
_Static_assert(sizeof element_layout / sizeof element_layout[0] == FM_ELEMENT_COUNT, "one each");

static GLuint build_vertex_array(const fm_gl *gl, const fm_pipeline_desc *desc)
{
    GLuint array = 0;
    gl->CreateVertexArrays(1, &array);
    for (uint32_t i = 0; i < desc->attribute_count; i++) {
        const fm_vertex_attribute *attribute = &desc->attributes[i];
        const GLint components =
            attribute->is_vec3 ? 3 : element_layout[attribute->element].components;
        if (element_layout[attribute->element].is_integer && !attribute->is_vec3)
            gl->VertexArrayAttribIFormat(array, attribute->location, components, GL_UNSIGNED_INT,
                                         attribute->offset_bytes);
        else
            gl->VertexArrayAttribFormat(array, attribute->location, components, GL_FLOAT, GL_FALSE,
                                        attribute->offset_bytes);
        gl->VertexArrayAttribBinding(array, attribute->location, 0);
        gl->EnableVertexArrayAttrib(array, attribute->location);
    }
    return array;
}

fm_status osmesa_pipeline_create(fm_pipeline **pipeline, fm_device *device,
                                 const fm_pipeline_desc *desc, fm_error *err)
{
    osmesa *self = osmesa_current(device);
    *pipeline = NULL;
    fm_status status = check_bindings(self, desc, err);
    if (status != FM_OK)
        return status;
    fm_pipeline *made = calloc(1, sizeof *made);
    if (made == NULL)
        return fm_fail(err, FM_NO_MEMORY, "%s: its handle", desc->name);
    status = osmesa_program_create(&made->program, self, desc, err);
    if (status != FM_OK)
        goto out;
    if (desc->compute == NULL)
        made->vertex_array = build_vertex_array(&self->gl, desc);
    made->state = desc->state;
    made->iteration = desc->iteration;
    memcpy(made->targets, desc->targets, sizeof made->targets);
    made->target_count = desc->target_count;
    made->samples = desc->samples == 0 ? 1 : desc->samples;
    made->vertex_stride_bytes = desc->vertex_stride_bytes;
    *pipeline = made;
    made = NULL;
out:
    osmesa_pipeline_destroy(device, made);
    return status;
}

void osmesa_pipeline_destroy(fm_device *device, fm_pipeline *pipeline)
{
    if (pipeline == NULL)
        return;
    const fm_gl *gl = &osmesa_current(device)->gl;
    gl->DeleteVertexArrays(1, &pipeline->vertex_array); /* 0 is ignored, as of programs */
    gl->DeleteProgram(pipeline->program);
    free(pipeline);
}
