#include "gl.h"

#include <stddef.h>
#include <string.h>

static const struct {
    const char *name;
    size_t offset;
} entry_points[] = {
#define ENTRY_POINT(function) { "gl" #function, offsetof(fm_gl, function) },
    FM_GL_FUNCTIONS(ENTRY_POINT)
#undef ENTRY_POINT
};

fm_status gl_load(fm_gl *gl, const osmesa_library *library, fm_error *err)
{
    for (size_t i = 0; i < sizeof entry_points / sizeof entry_points[0]; i++) {
        const OSMESAproc function = library->function(entry_points[i].name);
        if (function == NULL)
            return fm_fail(err, FM_IO, "osmesa: this libOSMesa has no %s", entry_points[i].name);
        memcpy((char *)gl + entry_points[i].offset, &function, sizeof function);
    }
    return FM_OK;
}

const char *gl_error_name(GLenum code)
{
    switch (code) {
    case GL_INVALID_ENUM:
        return "GL_INVALID_ENUM";
    case GL_INVALID_VALUE:
        return "GL_INVALID_VALUE";
    case GL_INVALID_OPERATION:
        return "GL_INVALID_OPERATION";
    case GL_INVALID_FRAMEBUFFER_OPERATION:
        return "GL_INVALID_FRAMEBUFFER_OPERATION";
    case GL_OUT_OF_MEMORY:
        return "GL_OUT_OF_MEMORY";
    case GL_CONTEXT_LOST:
        return "GL_CONTEXT_LOST";
    default:
        return "an unknown OpenGL error";
    }
}

fm_status gl_check_storage(const fm_gl *gl, const char *kind, const char *name, uint64_t bytes,
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
