#include "family.h"

#include <string.h>

static const char *const family_names[] = {
    [FM_FAMILY_CONTROL] = "control",
    [FM_FAMILY_Z_BUFFER] = "z-buffer",
    [FM_FAMILY_PEELING] = "peeling",
    [FM_FAMILY_K_BUFFER] = "k-buffer",
    [FM_FAMILY_K_PLUS_BUFFER] = "k-plus-buffer",
    [FM_FAMILY_A_BUFFER] = "a-buffer",
    [FM_FAMILY_LINKED_LIST] = "linked-list",
    [FM_FAMILY_RASTERISER] = "rasteriser",
};
_Static_assert(sizeof family_names / sizeof family_names[0] == FM_FAMILY_COUNT,
               "one name a family");

static const char *const marker_names[] = {
    [FM_MARKER_CIRCLE] = "circle", [FM_MARKER_SQUARE] = "square", [FM_MARKER_DIAMOND] = "diamond",
    [FM_MARKER_PLUS] = "plus",     [FM_MARKER_CROSS] = "cross",
};
_Static_assert(sizeof marker_names / sizeof marker_names[0] == FM_MARKER_COUNT,
               "one name a marker");

/* In the order of FM_TRAIT_*'s bits. */
static const struct {
    const char *name, *words;
} traits[] = {
    { "exact", "exact" },
    { "bounded", "bounded" },
    { "sorted_input", "needs sorted input" },
    { "sorts_in_resolve", "sorts in resolve" },
    { "loses_depth_one", "loses depth 1" },
    { "loses_ties", "loses ties" },
    { "racy", "fragments race" },
    { "approximate", "approximate" },
    { "control", "control" },
    { "floor", "none: the floor" },
    { "emits_back", "emits from the back" },
    { "reads_colour", "reads colours" },
    { "emits_either", "emits either way" },
    { "multisampled", "keeps samples" },
    { "passes_lose_ties", "passes lose ties" },
};
enum { TRAIT_COUNT = sizeof traits / sizeof traits[0] };
_Static_assert((1u << TRAIT_COUNT) == FM_TRAITS_ALL + 1u, "one name a trait");

const char *trait_name(unsigned bit)
{
    return bit < TRAIT_COUNT ? traits[bit].name : NULL;
}

const char *trait_words(unsigned bit)
{
    return bit < TRAIT_COUNT ? traits[bit].words : NULL;
}

const char *marker_name(fm_marker marker)
{
    return marker_names[marker];
}

const char *family_name(fm_family family)
{
    return family_names[family];
}

fm_family family_parse(const char *name)
{
    for (int i = 0; name != NULL && i < FM_FAMILY_COUNT; i++)
        if (strcmp(name, family_names[i]) == 0)
            return (fm_family)i;
    return FM_FAMILY_CONTROL;
}

fm_marker marker_parse(const char *name)
{
    for (int i = 0; name != NULL && i < FM_MARKER_COUNT; i++)
        if (strcmp(name, marker_names[i]) == 0)
            return (fm_marker)i;
    return FM_MARKER_CIRCLE;
}
