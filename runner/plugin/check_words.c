#include "check_words.h"

#include <ctype.h>
#include <stdlib.h>
#include <string.h>

#include "base/text.h"

/* What GLSL 4.50 and its Vulkan flavour reserve, as far as a lower-case name could hit it.
 * Sorted. */
static const char *const reserved[] = {
    "active",   "asm",      "atomic_uint", "attribute", "bool",      "break",      "buffer",
    "case",     "cast",     "centroid",    "class",     "coherent",  "common",     "const",
    "continue", "default",  "discard",     "do",        "double",    "dvec2",      "dvec3",
    "dvec4",    "else",     "enum",        "extern",    "external",  "false",      "filter",
    "fixed",    "flat",     "float",       "for",       "fvec2",     "fvec3",      "fvec4",
    "goto",     "half",     "highp",       "hvec2",     "hvec3",     "hvec4",      "if",
    "in",       "inline",   "inout",       "input",     "int",       "interface",  "invariant",
    "ivec2",    "ivec3",    "ivec4",       "layout",    "long",      "lowp",       "main",
    "mat2",     "mat3",     "mat4",        "mediump",   "namespace", "noinline",   "noperspective",
    "out",      "output",   "partition",   "patch",     "precise",   "precision",  "public",
    "readonly", "resource", "restrict",    "return",    "sample",    "sampler",    "shared",
    "short",    "sizeof",   "smooth",      "static",    "struct",    "subroutine", "superp",
    "switch",   "template", "this",        "true",      "typedef",   "uint",       "uniform",
    "union",    "unsigned", "using",       "uvec2",     "uvec3",     "uvec4",      "varying",
    "vec2",     "vec3",     "vec4",        "void",      "volatile",  "while",      "writeonly",
};

static int compare_words(const void *left, const void *right)
{
    return strcmp(*(const char *const *)left, *(const char *const *)right);
}

bool check_is_taken(const char *name)
{
    return strncmp(name, "gl_", 3) == 0 || strncmp(name, "fm_", 3) == 0 ||
           strstr(name, "__") != NULL;
}

bool check_is_reserved(const char *name)
{
    return check_is_taken(name) || bsearch(&name, reserved, sizeof reserved / sizeof reserved[0],
                                           sizeof reserved[0], compare_words) != NULL;
}

bool check_is_word(const char *name, const char *others)
{
    static const char letters[] = "abcdefghijklmnopqrstuvwxyz";
    if (*name == '\0' || strchr(letters, *name) == NULL)
        return false;
    for (name++; *name != '\0'; name++)
        if (strchr(letters, *name) == NULL && strchr("0123456789", *name) == NULL &&
            strchr(others, *name) == NULL)
            return false;
    return true;
}

void check_fold_name(char *name)
{
    for (; *name != '\0'; name++)
        if (!isalnum((unsigned char)*name))
            *name = '_';
}

fm_status check_range(unsigned value, unsigned count, const char *field, fm_error *err)
{
    if (value >= count)
        return fm_fail(err, FM_INVALID, "%s: %u: no such value, at most %u", field, value,
                       count - 1);
    return FM_OK;
}

static const char *name_at(const char *const *first, size_t stride_bytes, size_t i)
{
    return *(const char *const *)((const char *)first + i * stride_bytes);
}

static fm_status check_length(size_t *count, const char *const *first, size_t stride_bytes,
                              size_t room, const char *list, fm_error *err)
{
    size_t length = 0;
    while (length < room && name_at(first, stride_bytes, length) != NULL)
        length++;
    for (size_t i = length; i < room; i++)
        if (name_at(first, stride_bytes, i) != NULL)
            return fm_fail(err, FM_INVALID, "%s[%zu]: '%s' stands behind an entry without a name",
                           list, i, name_at(first, stride_bytes, i));
    for (size_t i = 0; i < length; i++)
        if (*name_at(first, stride_bytes, i) == '\0')
            return fm_fail(err, FM_INVALID, "%s[%zu]: empty name", list, i);
    *count = length;
    return FM_OK;
}

fm_status check_list(size_t *count, const char *const *first, size_t stride_bytes, size_t room,
                     const char *list, fm_error *err)
{
    const fm_status status = check_length(count, first, stride_bytes, room, list, err);
    for (size_t i = 0; status == FM_OK && i < *count; i++)
        for (size_t j = 0; j < i; j++)
            if (strcmp(name_at(first, stride_bytes, i), name_at(first, stride_bytes, j)) == 0)
                return fm_fail(err, FM_INVALID, "%s[%zu]: '%s' is there twice", list, i,
                               name_at(first, stride_bytes, i));
    return status;
}

fm_status check_names(fm_known_names *names, const char *const *first, size_t stride_bytes,
                      size_t room, fm_error *err)
{
    const fm_status status =
        names->may_repeat ? check_length(&names->count, first, stride_bytes, room, names->list, err)
                          : check_list(&names->count, first, stride_bytes, room, names->list, err);
    for (size_t i = 0; status == FM_OK && i < names->count; i++)
        names->items[i] = name_at(first, stride_bytes, i);
    return status;
}

fm_status check_known(size_t *index, const char *word, const char *field,
                      const fm_known_names *names, fm_error *err)
{
    for (*index = 0; *index < names->count; ++*index)
        if (strcmp(word, names->items[*index]) == 0)
            return FM_OK;
    const char *nearest = text_nearest(word, names->items, names->count);
    if (nearest == NULL)
        return fm_fail(err, FM_INVALID, "%s '%s': no such %s", field, word, names->what);
    return fm_fail(err, FM_INVALID, "%s '%s': no such %s; nearest is '%s'", field, word,
                   names->what, nearest);
}
