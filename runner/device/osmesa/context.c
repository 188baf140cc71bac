#include <assert.h>

#include "context.h"

fm_status osmesa_context_create(osmesa *self, fm_error *err)
{
    static const int attributes[] = {
        OSMESA_FORMAT,
        OSMESA_RGBA,
        OSMESA_PROFILE,
        OSMESA_CORE_PROFILE,
        OSMESA_CONTEXT_MAJOR_VERSION,
        4,
        OSMESA_CONTEXT_MINOR_VERSION,
        5,
        0,
        0,
    };
    const fm_status status = osmesa_library_open(&self->library, err);
    if (status != FM_OK)
        return status;
    self->context = self->library.create_context(attributes, NULL);
    if (self->context == NULL)
        return fm_fail(err, FM_IO,
                       "osmesa: no OpenGL 4.5 core context; install libosmesa6 with llvmpipe");
    if (!self->library.make_current(self->context, self->window, GL_UNSIGNED_BYTE, OSMESA_WINDOW_PX,
                                    OSMESA_WINDOW_PX))
        return fm_fail(err, FM_IO, "osmesa: the context cannot be made current");
    return gl_load(&self->gl, &self->library, err);
}

osmesa *osmesa_current(fm_device *device)
{
    osmesa *self = (osmesa *)device;
    if (self->library.current_context() != self->context) {
        const bool is_current = self->library.make_current(
            self->context, self->window, GL_UNSIGNED_BYTE, OSMESA_WINDOW_PX, OSMESA_WINDOW_PX);
        assert(is_current); /* fails for a wrong window only, and open() has tried this one */
        (void)is_current;
    }
    return self;
}
