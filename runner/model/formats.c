#include "formats.h"

static const struct format_info {
    uint32_t bytes;
    bool has_depth, is_integer;
} formats[] = {
    [FM_FORMAT_NONE] = { .bytes = 0 },
    [FM_FORMAT_R32UI] = { .bytes = 4, .is_integer = true },
    [FM_FORMAT_RG32UI] = { .bytes = 8, .is_integer = true },
    [FM_FORMAT_RGBA32UI] = { .bytes = 16, .is_integer = true },
    [FM_FORMAT_R32F] = { .bytes = 4 },
    [FM_FORMAT_RG32F] = { .bytes = 8 },
    [FM_FORMAT_RGBA32F] = { .bytes = 16 },
    [FM_FORMAT_RGBA8] = { .bytes = 4 },
    [FM_FORMAT_D32F] = { .bytes = 4, .has_depth = true },
    [FM_FORMAT_D32F_S8] = { .bytes = 5, .has_depth = true },
    [FM_FORMAT_R8] = { .bytes = 1 },
    [FM_FORMAT_R16] = { .bytes = 2 },
    [FM_FORMAT_RG16] = { .bytes = 4 },
    [FM_FORMAT_RGBA16] = { .bytes = 8 },
    [FM_FORMAT_R16F] = { .bytes = 2 },
    [FM_FORMAT_RG16F] = { .bytes = 4 },
    [FM_FORMAT_RGBA16F] = { .bytes = 8 },
};
_Static_assert(sizeof formats / sizeof formats[0] == FM_FORMAT_COUNT, "one row a format");

static const uint32_t bytes_of_element[] = {
    [FM_ELEMENT_UINT] = 4, [FM_ELEMENT_UVEC2] = 8, [FM_ELEMENT_UVEC4] = 16, [FM_ELEMENT_FLOAT] = 4,
    [FM_ELEMENT_VEC2] = 8, [FM_ELEMENT_VEC4] = 16, [FM_ELEMENT_UINT64] = 8,
};
_Static_assert(sizeof bytes_of_element / sizeof bytes_of_element[0] == FM_ELEMENT_COUNT,
               "one an element");

uint32_t format_bytes(fm_format format)
{
    return formats[format].bytes;
}

bool format_has_depth(fm_format format)
{
    return formats[format].has_depth;
}

bool format_is_integer(fm_format format)
{
    return formats[format].is_integer;
}

uint32_t element_bytes(fm_element element)
{
    return bytes_of_element[element];
}
