#include "look.h"

static const fm_colour family_colours[] = {
    [FM_FAMILY_CONTROL] = { 0, 0, 0 },           [FM_FAMILY_Z_BUFFER] = { 204, 121, 167 },
    [FM_FAMILY_PEELING] = { 240, 228, 66 },      [FM_FAMILY_K_BUFFER] = { 230, 159, 0 },
    [FM_FAMILY_K_PLUS_BUFFER] = { 0, 114, 178 }, [FM_FAMILY_A_BUFFER] = { 213, 94, 0 },
    [FM_FAMILY_LINKED_LIST] = { 0, 158, 115 },   [FM_FAMILY_RASTERISER] = { 86, 180, 233 },
};
_Static_assert(sizeof family_colours / sizeof family_colours[0] == FM_FAMILY_COUNT,
               "one colour a family");

/* Light to dark and back, so that neighbours in a stack differ in grey print too. */
static const fm_colour part_colours[FM_LOOK_PARTS] = {
    { 187, 187, 187 }, { 240, 228, 66 }, { 204, 121, 167 }, { 0, 114, 178 },
    { 230, 159, 0 },   { 0, 158, 115 },  { 86, 180, 233 },  { 213, 94, 0 },
};

fm_colour look_family_colour(fm_family family)
{
    return family_colours[family];
}

fm_colour look_shade(fm_colour colour, size_t variant)
{
    static const unsigned percent[] = { 100, 84, 68, 54, 40, 28 };
    const size_t last = sizeof percent / sizeof percent[0] - 1;
    const unsigned share = percent[variant < last ? variant : last];
    return (fm_colour){ .r = (uint8_t)(colour.r * share / 100),
                        .g = (uint8_t)(colour.g * share / 100),
                        .b = (uint8_t)(colour.b * share / 100) };
}

fm_colour look_part_colour(size_t part)
{
    return part_colours[part % FM_LOOK_PARTS];
}

fm_colour look_dominated_colour(void)
{
    return (fm_colour){ 170, 170, 170 };
}
