#include "context.h"

static const osmesa_format formats[] = {
    [FM_FORMAT_NONE] = { .internal = GL_NONE },
    [FM_FORMAT_R32UI] = { .internal = GL_R32UI, .is_integer = true },
    [FM_FORMAT_RG32UI] = { .internal = GL_RG32UI, .is_integer = true },
    [FM_FORMAT_RGBA32UI] = { .internal = GL_RGBA32UI, .is_integer = true },
    [FM_FORMAT_R32F] = { .internal = GL_R32F },
    [FM_FORMAT_RG32F] = { .internal = GL_RG32F },
    [FM_FORMAT_RGBA32F] = { .internal = GL_RGBA32F },
    [FM_FORMAT_RGBA8] = { .internal = GL_RGBA8 },
    [FM_FORMAT_D32F] = { .internal = GL_DEPTH_COMPONENT32F, .has_depth = true },
    [FM_FORMAT_D32F_S8] = { .internal = GL_DEPTH32F_STENCIL8,
                            .has_depth = true,
                            .has_stencil = true },
    [FM_FORMAT_R8] = { .internal = GL_R8 },
    [FM_FORMAT_R16] = { .internal = GL_R16 },
    [FM_FORMAT_RG16] = { .internal = GL_RG16 },
    [FM_FORMAT_RGBA16] = { .internal = GL_RGBA16 },
    [FM_FORMAT_R16F] = { .internal = GL_R16F },
    [FM_FORMAT_RG16F] = { .internal = GL_RG16F },
    [FM_FORMAT_RGBA16F] = { .internal = GL_RGBA16F },
};
_Static_assert(sizeof formats / sizeof formats[0] == FM_FORMAT_COUNT, "one a format");

const osmesa_format *osmesa_format_of(fm_format format)
{
    return &formats[format];
}
