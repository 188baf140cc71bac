#include <assert.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "context.h"
#include "device/shader_fault.h"

enum { LOG_MAX_BYTES = 1024 };

/* OpenGL's names of what GLSL for Vulkan calls so. They go behind the #version line; the line
 * numbers of messages stay those of the text that was handed in. */
static const char vulkan_names[] = "#define gl_VertexIndex gl_VertexID\n"
                                   "#define gl_InstanceIndex gl_InstanceID\n"
                                   "#line 2\n";

typedef struct shader_stage {
    GLenum type;
    const char *name;
    const char *source; /* NULL: the pipeline does not have it */
} shader_stage;

/* The first line of the log that is an error: "0:LINE(COLUMN): error: ..."; 0: none says. */
static unsigned find_error_line(const char *log)
{
    for (const char *at = log; at != NULL; at = strchr(at, '\n')) {
        unsigned line = 0;
        int end = 0; /* stays 0 if the word is not "error": a warning */
        at += *at == '\n';
        if (sscanf(at, "0:%u(%*u): error%n", &line, &end) == 1 && end > 0)
            return line;
        if (*at == '\0')
            break;
    }
    return 0;
}

static fm_status compile_stage(const fm_gl *gl, GLuint program, const shader_stage *stage,
                               const char *pipeline, fm_error *err)
{
    const size_t version_bytes = strcspn(stage->source, "\n");
    const char *rest = stage->source + version_bytes;
    rest += *rest == '\n';
    const char *const parts[] = { stage->source, "\n", vulkan_names, rest };
    const GLint lengths[] = { (GLint)version_bytes, -1, -1, -1 };
    GLint is_compiled = GL_FALSE;
    const GLuint shader = gl->CreateShader(stage->type);
    gl->ShaderSource(shader, 4, parts, lengths);
    gl->CompileShader(shader);
    gl->GetShaderiv(shader, GL_COMPILE_STATUS, &is_compiled);
    if (is_compiled) {
        gl->AttachShader(program, shader);
        gl->DeleteShader(shader); /* when the program goes */
        return FM_OK;
    }
    char log[LOG_MAX_BYTES] = "";
    gl->GetShaderInfoLog(shader, sizeof log, NULL, log);
    gl->DeleteShader(shader);
    return device_fail_shader(err, &(fm_shader_fault){ .pipeline = pipeline,
                                                       .stage = stage->name,
                                                       .source = stage->source,
                                                       .log = log,
                                                       .line = find_error_line(log) });
}

static const char *const binding_kind_name[] = {
    [FM_BINDING_UNIFORM] = "uniform buffers",      [FM_BINDING_STORAGE] = "storage buffers",
    [FM_BINDING_ADDRESS] = "buffers by address",   [FM_BINDING_SAMPLED] = "sampled images",
    [FM_BINDING_STORAGE_IMAGE] = "storage images",
};

/* Numbers are unique across kinds for Vulkan's sake; each OpenGL kind has a name space and an end
 * of its own. */
static fm_status check_bindings(const osmesa *self, const fm_pipeline_desc *desc, fm_error *err)
{
    for (uint32_t i = 0; i < desc->binding_count; i++) {
        const fm_pipeline_binding *binding = &desc->bindings[i];
        assert(binding->kind != FM_BINDING_ADDRESS);
        if (binding->binding >= (uint32_t)self->limits.binding_end[binding->kind])
            return fm_fail(err, FM_UNSUPPORTED,
                           "%s: binding %u, %s of this device end before binding %d", desc->name,
                           binding->binding, binding_kind_name[binding->kind],
                           self->limits.binding_end[binding->kind]);
    }
    return FM_OK;
}

/* A program that does not link because it binds too much is not wrong, only not for here. What a
 * shader declares without using counts for nothing, therefore only the linker can tell. */
static fm_status fail_link(const osmesa *self, GLuint program, const fm_pipeline_desc *desc,
                           fm_error *err)
{
    char log[LOG_MAX_BYTES] = "";
    GLint counts[FM_BINDING_STORAGE_IMAGE + 1] = { 0 };
    for (uint32_t i = 0; i < desc->binding_count; i++) {
        const fm_binding_kind kind = desc->bindings[i].kind;
        if (++counts[kind] > self->limits.per_stage[kind])
            return fm_fail(err, FM_UNSUPPORTED,
                           "%s: more than %d %s, the most of a shader on this device", desc->name,
                           self->limits.per_stage[kind], binding_kind_name[kind]);
    }
    self->gl.GetProgramInfoLog(program, sizeof log, NULL, log);
    return fm_fail(err, FM_SHADER, "%s: linking: %s", desc->name, log);
}

static fm_status build_program(GLuint *program, const osmesa *self, const fm_pipeline_desc *desc,
                               fm_error *err)
{
    const fm_gl *gl = &self->gl;
    const shader_stage stages[] = {
        { GL_COMPUTE_SHADER, "compute", desc->compute },
        { GL_VERTEX_SHADER, "vertex", desc->vertex },
        { GL_FRAGMENT_SHADER, "fragment", desc->fragment },
    };
    GLint is_linked = GL_FALSE;
    fm_status status = FM_OK;
    *program = gl->CreateProgram();
    for (size_t i = 0; i < sizeof stages / sizeof stages[0]; i++) {
        if (stages[i].source == NULL)
            continue;
        status = compile_stage(gl, *program, &stages[i], desc->name, err);
        if (status != FM_OK)
            return status;
    }
    gl->LinkProgram(*program);
    gl->GetProgramiv(*program, GL_LINK_STATUS, &is_linked);
    return is_linked ? FM_OK : fail_link(self, *program, desc, err);
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
    status = build_program(&made->program, self, desc, err);
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
