#include "plugin_check.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "base/text.h"
#include "plugin.h"

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

void check_fold_hyphens(char *name)
{
    for (; *name != '\0'; name++)
        if (*name == '-')
            *name = '_';
}

bool check_is_depth_format(fm_format format)
{
    return format == FM_FORMAT_D32F || format == FM_FORMAT_D32F_S8;
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

fm_status check_list(size_t *count, const char *const *first, size_t stride_bytes, size_t room,
                     const char *list, fm_error *err)
{
    size_t length = 0;
    while (length < room && name_at(first, stride_bytes, length) != NULL)
        length++;
    for (size_t i = length; i < room; i++)
        if (name_at(first, stride_bytes, i) != NULL)
            return fm_fail(err, FM_INVALID, "%s[%zu]: '%s' stands behind an entry without a name",
                           list, i, name_at(first, stride_bytes, i));
    for (size_t i = 0; i < length; i++) {
        const char *name = name_at(first, stride_bytes, i);
        if (*name == '\0')
            return fm_fail(err, FM_INVALID, "%s[%zu]: empty name", list, i);
        for (size_t j = 0; j < i; j++)
            if (strcmp(name, name_at(first, stride_bytes, j)) == 0)
                return fm_fail(err, FM_INVALID, "%s[%zu]: '%s' is there twice", list, i, name);
    }
    *count = length;
    return FM_OK;
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

static fm_status take_names(fm_known_names *names, const char *const *first, size_t stride_bytes,
                            size_t room, fm_error *err)
{
    const fm_status status = check_list(&names->count, first, stride_bytes, room, names->list, err);
    for (size_t i = 0; status == FM_OK && i < names->count; i++)
        names->items[i] = name_at(first, stride_bytes, i);
    return status;
}

static fm_status take_lists(fm_checked_method *check, fm_error *err)
{
    const fm_method_desc *m = check->method;
    fm_status status =
        take_names(&check->options, &m->options[0].name, sizeof m->options[0], FM_MAX_OPTIONS, err);
    if (status == FM_OK)
        status = take_names(&check->resources, &m->resources[0].name, sizeof m->resources[0],
                            FM_MAX_RESOURCES, err);
    if (status == FM_OK)
        status =
            take_names(&check->totals, &m->totals[0].name, sizeof m->totals[0], FM_MAX_TOTALS, err);
    if (status == FM_OK)
        status =
            take_names(&check->passes, &m->passes[0].name, sizeof m->passes[0], FM_MAX_PASSES, err);
    return status;
}

static fm_status check_id(const char *id, fm_error *err)
{
    const size_t room = sizeof((fm_plugin_entry *)0)->id;
    if (id == NULL || !check_is_word(id, "-") || strstr(id, "--") != NULL ||
        id[strlen(id) - 1] == '-')
        return fm_fail(err, FM_INVALID, "id: '%s': needs lower-case letters, digits and hyphens",
                       id == NULL ? "" : id);
    if (strlen(id) >= room)
        return fm_fail(err, FM_INVALID, "id: '%s': %zu letters at most", id, room - 1);
    if (strcmp(id, "common") == 0)
        return fm_fail(err, FM_INVALID, "id: 'common' is the folder of the runner's GLSL");
    return FM_OK;
}

static fm_status check_text(const char *text, const char *field, fm_error *err)
{
    if (text == NULL || *text == '\0')
        return fm_fail(err, FM_INVALID, "%s: missing", field);
    if (!text_is_utf8(text))
        return fm_fail(err, FM_INVALID, "%s: not UTF-8", field);
    return FM_OK;
}

static fm_status check_bits(uint32_t bits, uint32_t all, const char *field, fm_error *err)
{
    if ((bits & ~all) != 0)
        return fm_fail(err, FM_INVALID, "%s: unknown bits 0x%" PRIX32, field, bits & ~all);
    return FM_OK;
}

static fm_status check_head(const fm_method_desc *m, fm_error *err)
{
    fm_status status = check_id(m->id, err);
    if (status == FM_OK)
        status = check_text(m->title, "title", err);
    if (status == FM_OK)
        status = check_text(m->citation, "citation", err);
    if (status == FM_OK)
        status = check_text(m->version, "version", err);
    if (status == FM_OK)
        status = check_bits(m->traits, FM_TRAITS_ALL, "traits", err);
    if (status == FM_OK)
        status = check_bits(m->features, FM_FEATURES_ALL, "features", err);
    if (status == FM_OK)
        status = check_bits(m->features_optional, FM_FEATURES_ALL, "features_optional", err);
    if (status == FM_OK)
        status = check_bits(m->feeds, FM_FEEDS_ALL, "feeds", err);
    if (status == FM_OK && (m->feeds & FM_FEED_TRIANGLES) != 0 && m->feeds != FM_FEED_TRIANGLES)
        status = fm_fail(err, FM_INVALID, "feeds: FM_FEED_TRIANGLES stands alone");
    if (status == FM_OK)
        status = check_range(m->keeps, FM_KEEPS_COUNT, "keeps", err);
    if (status == FM_OK)
        status = check_range(m->family, FM_FAMILY_COUNT, "family", err);
    if (status == FM_OK)
        status = check_range(m->marker, FM_MARKER_COUNT, "marker", err);
    if (status == FM_OK && (m->traits & FM_TRAIT_EXACT) && (m->traits & FM_TRAIT_APPROXIMATE))
        status = fm_fail(err, FM_INVALID, "traits: exact and approximate exclude each other");
    return status;
}

static fm_status check_body(const fm_checked_method *check, fm_error *err)
{
    if (check->method->technique != NULL)
        return check_technique(check, err);
    if ((check->method->feeds & FM_FEED_FRAMES) != 0)
        return fm_fail(err, FM_INVALID, "feeds: 'frames' is for methods with a technique");
    fm_status status = check_resources(check, err);
    if (status == FM_OK)
        status = check_totals(check, err);
    if (status == FM_OK)
        status = check_passes(check, err);
    if (status == FM_OK)
        status = check_loops(check, err);
    return status;
}

static fm_status check_all(const fm_method_desc *method, fm_error *err)
{
    fm_checked_method check = { .method = method,
                                .options = { .what = "option", .list = "options" },
                                .resources = { .what = "resource", .list = "resources" },
                                .totals = { .what = "total", .list = "totals" },
                                .passes = { .what = "pass", .list = "passes" } };
    if (method->abi != FM_ABI)
        return fm_fail(err, FM_INVALID,
                       "abi: the plugin has %" PRIu32 ", this program takes %u: build it again",
                       method->abi, FM_ABI);
    if (method->size_bytes != sizeof *method)
        return fm_fail(err, FM_INVALID,
                       "size_bytes: the plugin has %" PRIu32 ", this program takes %zu",
                       method->size_bytes, sizeof *method);
    fm_status status = check_head(method, err);
    if (status == FM_OK)
        status = take_lists(&check, err);
    if (status == FM_OK)
        status = check_options(&check, err);
    return status == FM_OK ? check_body(&check, err) : status;
}

fm_status plugin_check(const fm_method_desc *method, const char *name, fm_error *err)
{
    fm_error ignored;
    if (err == NULL)
        err = &ignored;
    const fm_status status = check_all(method, err);
    return status == FM_OK ? FM_OK : fm_error_prefix(err, "%s", name);
}
