/* Passes of a descriptor: names, shaders, accesses and flags. What they draw into is checked in
 * check_attachments.c. */
#include <inttypes.h>
#include <string.h>

#include "check_later.h"
#include "check_method.h"
#include "culling_apply.h"
#include "model/formats.h"
#include "model/formula.h"

enum { NAME_MAX_BYTES = 64 };

/* What a kind of pass may have. */
typedef struct kind_rule {
    const char *name;
    bool has_shader, has_targets;
} kind_rule;

static const kind_rule kind_rules[] = {
    [FM_PASS_SCENE] = { "scene", true, true },   [FM_PASS_PIXELS] = { "pixels", true, true },
    [FM_PASS_TILES] = { "tiles", true, false },  [FM_PASS_TRIANGLES] = { "triangles", true, false },
    [FM_PASS_TOTAL] = { "total", true, false },  [FM_PASS_INDIRECT] = { "indirect", true, false },
    [FM_PASS_CLEAR] = { "clear", false, false }, [FM_PASS_HOST] = { "host", false, false },
};
_Static_assert(sizeof kind_rules / sizeof kind_rules[0] == FM_PASS_KIND_COUNT, "one rule a kind");

/* A pass that is not a scene pass defines a function of its name beside the resources. */
static fm_status check_pass_name(const fm_checked_method *check, const fm_pass *pass, fm_error *err)
{
    char function[NAME_MAX_BYTES];
    const size_t length = strlen(pass->name);
    if (!check_is_word(pass->name, "-") || length >= sizeof function)
        return fm_fail(err, FM_INVALID, "name: needs lower-case letters, digits and hyphens");
    if (culling_is_map_pass(pass))
        return fm_fail(err, FM_INVALID, "name: '%s' begins like culling's own", pass->name);
    if (!kind_rules[pass->kind].has_shader || pass->kind == FM_PASS_SCENE)
        return FM_OK;
    memcpy(function, pass->name, length + 1);
    check_fold_name(function);
    if (check_is_reserved(function))
        return fm_fail(err, FM_INVALID, "name: its function '%s' is a reserved word", function);
    for (size_t i = 0; i < check->resources.count; i++)
        if (strcmp(function, check->resources.items[i]) == 0)
            return fm_fail(err, FM_INVALID, "name: its function '%s' is a resource's name too",
                           function);
    return FM_OK;
}

static bool is_file_name(const char *name, size_t length)
{
    static const char legal[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-.";
    return length > 0 && name[0] != '.' && strspn(name, legal) >= length;
}

static fm_status check_shader(const fm_pass *pass, fm_error *err)
{
    static const char suffix[] = ".glsl";
    const kind_rule *rule = &kind_rules[pass->kind];
    if (!rule->has_shader && pass->shader != NULL)
        return fm_fail(err, FM_INVALID, "shader '%s': a pass of kind %s has none", pass->shader,
                       rule->name);
    if (!rule->has_shader)
        return FM_OK;
    if (pass->shader == NULL || *pass->shader == '\0')
        return fm_fail(err, FM_INVALID, "shader: missing: a pass of kind %s needs one", rule->name);
    const char *slash = strchr(pass->shader, '/');
    const char *file = slash == NULL ? pass->shader : slash + 1;
    const size_t length = strlen(file), suffix_length = sizeof suffix - 1;
    if ((slash != NULL && !is_file_name(pass->shader, (size_t)(slash - pass->shader))) ||
        !is_file_name(file, length) || length <= suffix_length ||
        strcmp(file + length - suffix_length, suffix) != 0)
        return fm_fail(err, FM_INVALID, "shader '%s': needs 'file.glsl' or 'METHOD/file.glsl'",
                       pass->shader);
    return FM_OK;
}

static const fm_resource *find_resource(const fm_checked_method *check, const char *name)
{
    for (size_t i = 0; i < check->resources.count; i++)
        if (strcmp(name, check->resources.items[i]) == 0)
            return &check->method->resources[i];
    return NULL;
}

/* The resource that `name` ("fragments_previous") is the other copy of, whether it has two or not.
 */
static const fm_resource *find_previous(const fm_checked_method *check, const char *name)
{
    for (size_t i = 0; i < check->resources.count; i++) {
        const size_t length = strlen(check->resources.items[i]);
        if (strncmp(name, check->resources.items[i], length) == 0 &&
            strcmp(name + length, "_previous") == 0)
            return &check->method->resources[i];
    }
    return NULL;
}

static fm_status check_access(const fm_checked_method *check, const char *name, const char *field,
                              bool may_be_previous, fm_error *err)
{
    size_t index;
    if (find_resource(check, name) != NULL)
        return FM_OK;
    const fm_resource *previous = find_previous(check, name);
    if (previous != NULL && !previous->ping_pong)
        return fm_fail(err, FM_INVALID, "%s '%s': '%s' has one copy: ping_pong is not set", field,
                       name, previous->name);
    if (previous != NULL && !may_be_previous)
        return fm_fail(err, FM_INVALID, "%s '%s': the previous copy can only be read", field, name);
    if (previous != NULL)
        return FM_OK;
    return check_known(&index, name, field, &check->resources, err);
}

/* A clear fills any image; a shader stores into colour images of one sample only. */
static bool shaders_store_into(const fm_resource *r)
{
    return r->kind == FM_RESOURCE_BUFFER || (!format_has_depth(r->format) && r->samples <= 1 &&
                                             r->samples_per_k == 0 && r->samples_option == NULL);
}

static fm_status check_written(const fm_checked_method *check, const fm_pass *pass,
                               const char *name, fm_error *err)
{
    for (size_t i = 0; i < check->resources.count; i++) { /* whichever of this name is there */
        const fm_resource *r = &check->method->resources[i];
        if (strcmp(r->name, name) == 0 && pass->kind != FM_PASS_CLEAR && !shaders_store_into(r))
            return fm_fail(err, FM_INVALID,
                           "writes '%s': shaders store into colour images of one sample only",
                           name);
    }
    return FM_OK;
}

static fm_status check_accesses(const fm_checked_method *check, const fm_pass *pass, fm_error *err)
{
    size_t read_count, write_count;
    fm_status status =
        check_list(&read_count, pass->reads, sizeof pass->reads[0], FM_MAX_ACCESSES, "reads", err);
    if (status == FM_OK)
        status = check_list(&write_count, pass->writes, sizeof pass->writes[0], FM_MAX_ACCESSES,
                            "writes", err);
    for (size_t i = 0; status == FM_OK && i < read_count; i++)
        status = check_access(check, pass->reads[i], "reads", true, err);
    for (size_t i = 0; status == FM_OK && i < write_count; i++) {
        status = check_access(check, pass->writes[i], "writes", false, err);
        if (status == FM_OK)
            status = check_written(check, pass, pass->writes[i], err);
    }
    if (status != FM_OK)
        return status;
    if (pass->kind == FM_PASS_CLEAR && (write_count == 0 || read_count > 0))
        return fm_fail(err, FM_INVALID, "a clear has writes and no reads");
    if (pass->kind == FM_PASS_HOST && (write_count > 0 || read_count > 0))
        return fm_fail(err, FM_INVALID,
                       "a pass of kind host has no reads or writes: it reads totals");
    if (pass->clear_word != 0 && pass->kind != FM_PASS_CLEAR)
        return fm_fail(err, FM_INVALID, "clear_word: only a clear has it");
    return FM_OK;
}

static fm_status check_kind_draws(const fm_pass *pass, fm_error *err)
{
    const kind_rule *rule = &kind_rules[pass->kind];
    if (rule->has_targets)
        return FM_OK;
    if (pass->targets[0].resource != NULL)
        return fm_fail(err, FM_INVALID, "targets: a pass of kind %s has none", rule->name);
    if (pass->state.depth_stencil != NULL)
        return fm_fail(err, FM_INVALID, "depth_stencil: a pass of kind %s has none", rule->name);
    return FM_OK;
}

/* A field that names an option, which has to have a value. */
static fm_status check_option_of(const fm_checked_method *check, const char *field,
                                 const char *option, const char *value, fm_error *err)
{
    size_t index;
    const fm_status status = check_known(&index, option, field, &check->options, err);
    if (status != FM_OK || option_has_value(&check->method->options[index], value))
        return status;
    return fm_fail(err, FM_INVALID, "%s '%s': has no value '%s'", field, option, value);
}

static fm_status check_flat_option(const fm_checked_method *check, const fm_pass *pass,
                                   fm_error *err)
{
    if (pass->flat_option == NULL)
        return FM_OK;
    if (!pass->flat_tessellation)
        return fm_fail(err, FM_INVALID, "flat_option: needs flat_tessellation");
    return check_option_of(check, "flat_option", pass->flat_option, "flat", err);
}

/* One word for each pixel, whichever of its name it is. */
static bool is_word_a_pixel(const fm_resource *r)
{
    static const fm_extent one = { .per_pixel = 1 };
    if (r->kind == FM_RESOURCE_IMAGE)
        return r->format == FM_FORMAT_R32UI && !image_is_array(r) && r->samples <= 1 &&
               r->samples_per_k == 0 && r->samples_option == NULL && !r->ping_pong;
    return r->element == FM_ELEMENT_UINT && r->sizing == FM_SIZE_FIXED && !r->ping_pong &&
           r->shares == NULL && memcmp(&r->extent, &one, sizeof one) == 0;
}

static fm_status check_lock_word(const fm_checked_method *check, const fm_pass *pass, fm_error *err)
{
    const char *word = pass->lock_word;
    bool is_written = false;
    if (word == NULL && pass->lock_word_option == NULL)
        return FM_OK;
    if (word == NULL)
        return fm_fail(err, FM_INVALID, "lock_word_option: needs lock_word");
    if (!pass->exclusive)
        return fm_fail(err, FM_INVALID, "lock_word: only exclusive passes have one");
    for (int i = 0; i < FM_MAX_ACCESSES && pass->writes[i] != NULL; i++)
        is_written = is_written || strcmp(pass->writes[i], word) == 0;
    if (!is_written)
        return fm_fail(err, FM_INVALID, "lock_word '%s': does not stand in writes", word);
    for (size_t i = 0; i < check->resources.count; i++) {
        const fm_resource *r = &check->method->resources[i];
        if (strcmp(r->name, word) == 0 && !is_word_a_pixel(r))
            return fm_fail(err, FM_INVALID,
                           "lock_word '%s': needs one word a pixel: a fixed buffer of "
                           "FM_ELEMENT_UINT, or an image of FM_FORMAT_R32UI with one layer and "
                           "one sample",
                           word);
        if (r->shares != NULL && strcmp(r->shares, word) == 0)
            return fm_fail(err, FM_INVALID, "lock_word '%s': '%s' shares its memory", word,
                           r->name);
    }
    return pass->lock_word_option != NULL
               ? check_option_of(check, "lock_word_option", pass->lock_word_option, "lock", err)
               : FM_OK;
}

static fm_status check_lanes(const fm_pass *pass, const char *name, uint32_t lanes, fm_error *err)
{
    if (lanes == 0)
        return FM_OK;
    if (pass->kind != FM_PASS_TILES && pass->kind != FM_PASS_TRIANGLES &&
        pass->kind != FM_PASS_TOTAL)
        return fm_fail(err, FM_INVALID, "%s: a pass of kind %s has none", name,
                       kind_rules[pass->kind].name);
    if (lanes > FM_GROUP_LANES || (lanes & (lanes - 1)) != 0)
        return fm_fail(err, FM_INVALID, "%s: %" PRIu32 ": a power of two, %d at most", name, lanes,
                       FM_GROUP_LANES);
    return FM_OK;
}

static fm_status check_flags(const fm_checked_method *check, const fm_pass *pass, fm_error *err)
{
    if (pass->exclusive && pass->kind != FM_PASS_SCENE)
        return fm_fail(err, FM_INVALID, "exclusive: only scene passes can be");
    if (pass->flat_tessellation && pass->kind != FM_PASS_SCENE)
        return fm_fail(err, FM_INVALID, "flat_tessellation: only scene passes can have it");
    if (check_range(pass->cover, FM_COVER_COUNT, "cover", err) != FM_OK ||
        check_range(pass->resumes, FM_RESUMES_COUNT, "resumes", err) != FM_OK)
        return FM_INVALID;
    if (pass->resumes != FM_RESUMES_NEVER && pass->kind != FM_PASS_PIXELS)
        return fm_fail(err, FM_INVALID, "resumes: only passes over pixels can");
    if (pass->cover != FM_COVER_NONE &&
        (pass->kind != FM_PASS_SCENE || check->method->feeds != FM_FEED_RASTER))
        return fm_fail(err, FM_INVALID,
                       "cover: only scene passes of methods that take the raster feed only");
    if (pass->emits && pass->kind != FM_PASS_PIXELS && pass->kind != FM_PASS_TILES &&
        pass->kind != FM_PASS_INDIRECT)
        return fm_fail(err, FM_INVALID, "emits: a pass of kind %s cannot",
                       kind_rules[pass->kind].name);
    if (check->method->feeds == FM_FEED_TRIANGLES && pass->kind == FM_PASS_SCENE)
        return fm_fail(err, FM_INVALID,
                       "kind scene: the feed triangles has no fragments, only triangles");
    fm_status status = check_lanes(pass, "lanes", pass->lanes, err);
    if (status == FM_OK)
        status = check_lanes(pass, "lanes_narrow", pass->lanes_narrow, err);
    if (status == FM_OK)
        status = check_flat_option(check, pass, err);
    return status == FM_OK ? check_lock_word(check, pass, err) : status;
}

/* count_total and indirect: needed by one kind, forbidden to the others. */
static fm_status check_counts(const fm_checked_method *check, const fm_pass *pass, fm_error *err)
{
    size_t index;
    if ((pass->kind == FM_PASS_TOTAL) != (pass->count_total != NULL))
        return fm_fail(err, FM_INVALID, "count_total: needed by kind total, and by no other");
    if ((pass->kind == FM_PASS_INDIRECT) != (pass->indirect != NULL))
        return fm_fail(err, FM_INVALID, "indirect: needed by kind indirect, and by no other");
    if (pass->count_total != NULL)
        return check_known(&index, pass->count_total, "count_total", &check->totals, err);
    if (pass->indirect == NULL)
        return FM_OK;
    const fm_status status =
        check_known(&index, pass->indirect, "indirect", &check->resources, err);
    if (status != FM_OK)
        return status;
    const fm_resource *r = &check->method->resources[index];
    if (check_unconditional(check, pass->indirect, "indirect", err) != FM_OK)
        return FM_INVALID;
    if (r->kind != FM_RESOURCE_BUFFER || r->element != FM_ELEMENT_UINT)
        return fm_fail(err, FM_INVALID, "indirect '%s': needs a buffer of FM_ELEMENT_UINT",
                       pass->indirect);
    return FM_OK;
}

static fm_status check_pass(const fm_checked_method *check, const fm_pass *pass, fm_error *err)
{
    fm_status status = check_range(pass->kind, FM_PASS_KIND_COUNT, "kind", err);
    if (status == FM_OK)
        status = check_pass_name(check, pass, err);
    if (status == FM_OK)
        status = check_shader(pass, err);
    if (status == FM_OK)
        status = check_accesses(check, pass, err);
    if (status == FM_OK)
        status = check_kind_draws(pass, err);
    if (status == FM_OK)
        status = check_attachments(check, pass, err);
    if (status == FM_OK)
        status = check_flags(check, pass, err);
    if (status == FM_OK)
        status = check_counts(check, pass, err);
    if (status == FM_OK)
        status = check_later_pass(pass, err);
    return status;
}

fm_status check_passes(const fm_checked_method *check, fm_error *err)
{
    bool emits = false;
    if (check->passes.count == 0)
        return fm_fail(err, FM_INVALID, "passes: none");
    for (size_t i = 0; i < check->passes.count; i++) {
        const fm_pass *pass = &check->method->passes[i];
        if (check_pass(check, pass, err) != FM_OK)
            return fm_error_prefix(err, "pass '%s'", pass->name);
        emits = emits || (pass->emits && !pass->narrow_only);
    }
    if (!emits && !(check->method->traits & FM_TRAIT_FLOOR))
        return fm_fail(err, FM_INVALID, "passes: none emits");
    return FM_OK;
}
