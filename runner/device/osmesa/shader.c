#include <stdio.h>
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
            return fm_refuse(err, FM_REASON_DEVICE_LIMIT,
                             "%s: more than %d %s, the most of a shader on this device", desc->name,
                             self->limits.per_stage[kind], osmesa_binding_kind_name(kind));
    }
    self->gl.GetProgramInfoLog(program, sizeof log, NULL, log);
    return fm_fail(err, FM_SHADER, "%s: linking: %s", desc->name, log);
}

fm_status osmesa_program_create(GLuint *program, const osmesa *self, const fm_pipeline_desc *desc,
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
