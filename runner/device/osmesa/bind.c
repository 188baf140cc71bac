#include "context.h"

static const char *const kind_name[] = {
    [FM_BINDING_UNIFORM] = "uniform buffers",      [FM_BINDING_STORAGE] = "storage buffers",
    [FM_BINDING_ADDRESS] = "buffers by address",   [FM_BINDING_SAMPLED] = "sampled images",
    [FM_BINDING_STORAGE_IMAGE] = "storage images",
};
_Static_assert(sizeof kind_name / sizeof kind_name[0] == FM_BINDING_STORAGE_IMAGE + 1, "each");

const char *osmesa_binding_kind_name(fm_binding_kind kind)
{
    return kind_name[kind];
}

static void bind_one(const fm_gl *gl, const fm_bind *bind)
{
    switch (bind->kind) {
    case FM_BINDING_UNIFORM:
        gl->BindBufferBase(GL_UNIFORM_BUFFER, bind->binding, bind->buffer->name);
        return;
    case FM_BINDING_STORAGE:
        gl->BindBufferBase(GL_SHADER_STORAGE_BUFFER, bind->binding, bind->buffer->name);
        return;
    case FM_BINDING_ADDRESS: /* for barriers only, and everything waits for everything here */
        return;
    case FM_BINDING_SAMPLED:
        gl->BindTextureUnit(bind->binding, bind->image->name);
        return;
    case FM_BINDING_STORAGE_IMAGE:
        gl->BindImageTexture(bind->binding, bind->image->name, 0, bind->image->is_array, 0,
                             GL_READ_WRITE, osmesa_format_of(bind->image->format)->internal);
        return;
    }
}

void osmesa_bind(const fm_gl *gl, const fm_bind *binds, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++)
        bind_one(gl, &binds[i]);
}
