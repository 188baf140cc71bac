#include "look.h"

#include <string.h>

static const struct {
    const char *name;
    fm_colour colour;
} families[] = {
    [FM_FAMILY_CONTROL] = { "control", { 0, 0, 0 } },
    [FM_FAMILY_Z_BUFFER] = { "z-buffer", { 204, 121, 167 } },
    [FM_FAMILY_PEELING] = { "peeling", { 240, 228, 66 } },
    [FM_FAMILY_K_BUFFER] = { "k-buffer", { 230, 159, 0 } },
    [FM_FAMILY_K_PLUS_BUFFER] = { "k-plus-buffer", { 0, 114, 178 } },
    [FM_FAMILY_A_BUFFER] = { "a-buffer", { 213, 94, 0 } },
    [FM_FAMILY_LINKED_LIST] = { "linked-list", { 0, 158, 115 } },
    [FM_FAMILY_RASTERISER] = { "rasteriser", { 86, 180, 233 } },
};
_Static_assert(sizeof families / sizeof families[0] == FM_FAMILY_COUNT, "one colour a family");

static const char *const marker_names[] = {
    [FM_MARKER_CIRCLE] = "circle", [FM_MARKER_SQUARE] = "square", [FM_MARKER_DIAMOND] = "diamond",
    [FM_MARKER_PLUS] = "plus",     [FM_MARKER_CROSS] = "cross",
};
_Static_assert(sizeof marker_names / sizeof marker_names[0] == FM_MARKER_COUNT,
               "one name a marker");

/* Light to dark and back, so that neighbours in a stack differ in grey print too. */
static const fm_colour part_colours[FM_LOOK_PARTS] = {
    { 187, 187, 187 }, { 240, 228, 66 }, { 204, 121, 167 }, { 0, 114, 178 },
    { 230, 159, 0 },   { 0, 158, 115 },  { 86, 180, 233 },  { 213, 94, 0 },
};

fm_colour look_family_colour(fm_family family)
{
    return families[family].colour;
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

const char *look_family_name(fm_family family)
{
    return families[family].name;
}

fm_family look_family(const char *name)
{
    for (int i = 0; name != NULL && i < FM_FAMILY_COUNT; i++)
        if (strcmp(name, families[i].name) == 0)
            return (fm_family)i;
    return FM_FAMILY_CONTROL;
}

fm_marker look_marker(const char *name)
{
    for (int i = 0; name != NULL && i < FM_MARKER_COUNT; i++)
        if (strcmp(name, marker_names[i]) == 0)
            return (fm_marker)i;
    return FM_MARKER_CIRCLE;
}
