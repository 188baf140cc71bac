#include "formats.h"

static const uint32_t bytes_of_format[] = {
    [FM_FORMAT_NONE] = 0,      [FM_FORMAT_R32UI] = 4, [FM_FORMAT_RG32UI] = 8,
    [FM_FORMAT_RGBA32UI] = 16, [FM_FORMAT_R32F] = 4,  [FM_FORMAT_RG32F] = 8,
    [FM_FORMAT_RGBA32F] = 16,  [FM_FORMAT_RGBA8] = 4, [FM_FORMAT_D32F] = 4,
    [FM_FORMAT_D32F_S8] = 5,
};
_Static_assert(sizeof bytes_of_format / sizeof bytes_of_format[0] == FM_FORMAT_COUNT,
               "one a format");

static const uint32_t bytes_of_element[] = {
    [FM_ELEMENT_UINT] = 4, [FM_ELEMENT_UVEC2] = 8, [FM_ELEMENT_UVEC4] = 16, [FM_ELEMENT_FLOAT] = 4,
    [FM_ELEMENT_VEC2] = 8, [FM_ELEMENT_VEC4] = 16, [FM_ELEMENT_UINT64] = 8,
};
_Static_assert(sizeof bytes_of_element / sizeof bytes_of_element[0] == FM_ELEMENT_COUNT,
               "one an element");

uint32_t format_bytes(fm_format format)
{
    return bytes_of_format[format];
}

uint32_t element_bytes(fm_element element)
{
    return bytes_of_element[element];
}
