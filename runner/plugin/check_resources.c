/* Resources of a descriptor: extents of buffers, formats of images. */
#include <inttypes.h>
#include <stdio.h>
#include <string.h>

#include "check_method.h"
#include "model/descriptor.h"
#include "model/formats.h"

enum { NAME_MAX_BYTES = 64, MAX_IMAGE_LAYERS = 2048, MAX_IMAGE_SAMPLES = 16 };
static const uint64_t max_constant = UINT64_C(1) << 40;
/* Elements of a pixel, tile, triangle, ...: what multiplies a count of the scene. */
static const uint64_t max_factor = UINT64_C(1) << 12;

/* `field` is "extent" or "grown", in messages. */
static fm_status check_term(uint64_t factor, const char *name, const char *factor_field,
                            const char *name_field, const char *field, fm_error *err)
{
    if (factor > 0 && name == NULL)
        return fm_fail(err, FM_INVALID, "%s.%s: needs %s.%s", field, factor_field, field,
                       name_field);
    if (factor == 0 && name != NULL)
        return fm_fail(err, FM_INVALID, "%s.%s: needs %s.%s", field, name_field, field,
                       factor_field);
    return FM_OK;
}

static fm_status check_factors(const uint64_t *factors, size_t count, const char *field,
                               fm_error *err)
{
    for (size_t i = 0; i < count; i++)
        if (factors[i] > max_factor)
            return fm_fail(err, FM_INVALID, "%s: a factor of %" PRIu64 ", %" PRIu64 " at most",
                           field, factors[i], max_factor);
    return FM_OK;
}

static fm_status check_extent_values(const fm_extent *e, const char *field, fm_error *err)
{
    const uint64_t factors[] = { e->per_pixel,  e->per_pixel_k,      e->per_pixel_n,
                                 e->per_tile,   e->per_triangle,     e->per_total,
                                 e->per_option, e->per_pixel_option, e->per_fragment };
    if (e->constant > max_constant)
        return fm_fail(err, FM_INVALID, "%s.constant: %" PRIu64 ", %" PRIu64 " at most", field,
                       e->constant, max_constant);
    if (e->k_step > 0 && e->per_pixel_k == 0)
        return fm_fail(err, FM_INVALID, "%s.k_step: needs %s.per_pixel_k", field, field);
    return check_factors(factors, sizeof factors / sizeof factors[0], field, err);
}

static fm_status check_extent_names(const fm_checked_method *check, const fm_extent *e,
                                    const char *field, fm_error *err)
{
    char name[32];
    size_t index;
    fm_status status = check_term(e->per_total, e->total, "per_total", "total", field, err);
    if (status == FM_OK)
        status = check_term(e->per_option + e->per_pixel_option, e->option, "per_option", "option",
                            field, err);
    snprintf(name, sizeof name, "%s.total", field);
    if (status == FM_OK && e->total != NULL)
        status = check_known(&index, e->total, name, &check->totals, err);
    snprintf(name, sizeof name, "%s.option", field);
    if (status == FM_OK && e->option != NULL)
        status = check_counting_option(check, e->option, name, err);
    return status;
}

static bool is_zero(const fm_extent *e)
{
    return (e->constant | e->per_pixel | e->per_pixel_k | e->per_pixel_n | e->per_tile |
            e->per_triangle | e->per_total | e->per_option | e->per_pixel_option |
            e->per_fragment) == 0;
}

static fm_status check_extent(const fm_checked_method *check, const fm_extent *e, fm_error *err)
{
    if (is_zero(e))
        return fm_fail(err, FM_INVALID, "extent: all terms are zero: a zero-sized buffer");
    if (e->per_fragment != 0)
        return fm_fail(err, FM_INVALID,
                       "extent.per_fragment: only `grown` has it: before a frame nobody has "
                       "counted its fragments");
    const fm_status status = check_extent_values(e, "extent", err);
    return status == FM_OK ? check_extent_names(check, e, "extent", err) : status;
}

static fm_status check_grown(const fm_checked_method *check, const fm_resource *r, fm_error *err)
{
    if (r->sizing != FM_SIZE_GROW && !is_zero(&r->grown))
        return fm_fail(err, FM_INVALID, "grown: only with FM_SIZE_GROW");
    const fm_status status = check_extent_values(&r->grown, "grown", err);
    return status == FM_OK ? check_extent_names(check, &r->grown, "grown", err) : status;
}

/* A fixed buffer whose memory another fixed buffer may lie in. */
static bool can_share(const fm_resource *r)
{
    return r->kind == FM_RESOURCE_BUFFER && r->sizing == FM_SIZE_FIXED && !r->ping_pong;
}

static fm_status check_shares(const fm_checked_method *check, const fm_resource *r, fm_error *err)
{
    size_t index;
    if (r->shares == NULL)
        return FM_OK;
    const fm_status status = check_known(&index, r->shares, "shares", &check->resources, err);
    if (status != FM_OK)
        return status;
    const fm_resource *owner = &check->method->resources[index];
    if (owner == r || owner->shares != NULL || !can_share(r) || !can_share(owner))
        return fm_fail(err, FM_INVALID,
                       "shares '%s': both need to be fixed buffers of one copy, and the owner's "
                       "memory its own",
                       r->shares);
    return FM_OK;
}

static fm_status check_sizing(const fm_checked_method *check, const fm_resource *r, fm_error *err)
{
    size_t index;
    const fm_status status = check_range(r->sizing, FM_SIZE_COUNT, "sizing", err);
    if (status != FM_OK)
        return status;
    if (r->sizing == FM_SIZE_AFTER_TOTAL && r->extent.total == NULL)
        return fm_fail(err, FM_INVALID, "sizing after a total: needs extent.total");
    if (r->sizing != FM_SIZE_AFTER_TOTAL && r->extent.total != NULL)
        return fm_fail(err, FM_INVALID,
                       "extent.total '%s' is known only after a pass: needs FM_SIZE_AFTER_TOTAL",
                       r->extent.total);
    if (r->sizing == FM_SIZE_GROW && r->overflow == NULL)
        return fm_fail(err, FM_INVALID, "sizing that grows: needs overflow, a total");
    if (r->sizing != FM_SIZE_GROW && r->overflow != NULL)
        return fm_fail(err, FM_INVALID, "overflow: only with FM_SIZE_GROW");
    if (r->overflow != NULL &&
        check_known(&index, r->overflow, "overflow", &check->totals, err) != FM_OK)
        return FM_INVALID;
    if (check_grown(check, r, err) != FM_OK)
        return FM_INVALID;
    return check_shares(check, r, err);
}

static bool has_clear_words(const fm_resource *r)
{
    return (r->clear_words[0] | r->clear_words[1] | r->clear_words[2] | r->clear_words[3]) != 0;
}

static fm_status check_buffer(const fm_checked_method *check, const fm_resource *r, fm_error *err)
{
    fm_status status = check_range(r->element, FM_ELEMENT_COUNT, "element", err);
    if (status != FM_OK)
        return status;
    if (r->format != FM_FORMAT_NONE || r->samples != 0 || r->samples_per_k != 0 || r->layers != 0 ||
        r->layers_per_k != 0 || r->samples_option != NULL)
        return fm_fail(err, FM_INVALID, "a buffer has no format, samples or layers");
    if (has_clear_words(r))
        return fm_fail(err, FM_INVALID,
                       "clear_words: for images; clear_word of a pass fills buffers");
    if (r->element == FM_ELEMENT_UINT64 && !(check->method->features & FM_FEATURE_INT64_ATOMICS))
        return fm_fail(err, FM_INVALID, "element: 64-bit needs FM_FEATURE_INT64_ATOMICS");
    status = check_extent(check, &r->extent, err);
    return status == FM_OK ? check_sizing(check, r, err) : status;
}

static bool has_clear_colour(const fm_resource *r)
{
    for (int i = 0; i < 4; i++)
        if (r->clear_colour[i] != 0.0f) /* a NaN is not */
            return true;
    return false;
}

static fm_status check_clear(const fm_resource *r, fm_error *err)
{
    if (!(r->clear_depth >= 0.0f && r->clear_depth <= 1.0f))
        return fm_fail(err, FM_INVALID, "clear_depth: from 0 to 1");
    if (r->clear_stencil > UINT8_MAX)
        return fm_fail(err, FM_INVALID, "clear_stencil: 255 at most");
    if (has_clear_words(r) && !format_is_integer(r->format))
        return fm_fail(err, FM_INVALID,
                       "clear_words: for integer formats; the others have clear_colour");
    if (has_clear_words(r) && has_clear_colour(r))
        return fm_fail(err, FM_INVALID, "clear_colour: clear_words is set too");
    return FM_OK;
}

/* Of an image: elements of each pixel, a layer each. */
static fm_status check_texels(const fm_checked_method *check, const fm_resource *r, fm_error *err)
{
    const fm_extent *e = &r->extent;
    const uint64_t others = e->constant | e->per_fragment | e->per_tile | e->per_triangle |
                            e->per_total | e->per_option;
    if (others != 0 || e->total != NULL)
        return fm_fail(err, FM_INVALID,
                       "extent: an image has the viewport's size: per_pixel, per_pixel_k, "
                       "per_pixel_n and per_pixel_option are its layers, and nothing else is set");
    if (!is_zero(e) && (r->layers > 0 || r->layers_per_k > 0))
        return fm_fail(err, FM_INVALID, "extent: layers are set too");
    if (check_extent_values(e, "extent", err) != FM_OK)
        return FM_INVALID;
    return check_extent_names(check, e, "extent", err);
}

static fm_status check_image(const fm_checked_method *check, const fm_resource *r, fm_error *err)
{
    const fm_extent none = { 0 };
    const fm_status status = check_range(r->format, FM_FORMAT_COUNT, "format", err);
    if (status != FM_OK)
        return status;
    if (r->format == FM_FORMAT_NONE)
        return fm_fail(err, FM_INVALID, "format: missing");
    if (memcmp(&r->grown, &none, sizeof none) != 0 || r->sizing != FM_SIZE_FIXED ||
        r->overflow != NULL || r->shares != NULL || r->element != FM_ELEMENT_UINT)
        return fm_fail(err, FM_INVALID,
                       "an image has the viewport's size: no element, sizing or overflow");
    if ((r->samples & (r->samples - 1)) != 0 || r->samples > MAX_IMAGE_SAMPLES)
        return fm_fail(err, FM_INVALID, "samples: %" PRIu32 ": a power of two, %d at most",
                       r->samples, MAX_IMAGE_SAMPLES);
    if (r->samples_per_k > MAX_IMAGE_SAMPLES)
        return fm_fail(err, FM_INVALID, "samples_per_k: %" PRIu32 ", %d at most", r->samples_per_k,
                       MAX_IMAGE_SAMPLES);
    if (r->layers > MAX_IMAGE_LAYERS || r->layers_per_k > MAX_IMAGE_LAYERS)
        return fm_fail(err, FM_INVALID, "layers: %d at most", MAX_IMAGE_LAYERS);
    if (r->samples_option != NULL &&
        check_counting_option(check, r->samples_option, "samples_option", err) != FM_OK)
        return FM_INVALID;
    return check_texels(check, r, err) == FM_OK ? check_clear(r, err) : FM_INVALID;
}

static bool has_samples(const fm_resource *r)
{
    return r->samples > 1 || r->samples_per_k > 0 || r->samples_option != NULL;
}

fm_status check_multisampled(const fm_checked_method *check, fm_error *err)
{
    const fm_method_desc *method = check->method;
    if ((method->traits & FM_TRAIT_MULTISAMPLED) == 0)
        return FM_OK;
    for (size_t i = 0; i < resource_count(method); i++)
        if (has_samples(&method->resources[i]))
            return FM_OK;
    return fm_fail(err, FM_INVALID, "traits: multisampled, but no image has samples");
}

/* Whether the same sizes both. The one that is replaced may not have been checked. */
static bool are_sized_alike(const fm_resource *r, const fm_resource *replaced)
{
    if (r->sizing != replaced->sizing || r->sizing == FM_SIZE_AFTER_TOTAL)
        return false;
    return r->sizing == FM_SIZE_FIXED ||
           (replaced->overflow != NULL && strcmp(r->overflow, replaced->overflow) == 0);
}

/* Of a stand-in or of what it replaces. */
static bool is_alone(const fm_resource *r)
{
    return r->shares == NULL && !r->ping_pong;
}

static fm_status check_condition_names(const fm_checked_method *check, const fm_resource *r,
                                       fm_error *err)
{
    size_t index;
    if (r->when_option == NULL)
        return fm_fail(err, FM_INVALID, "when_value '%s': needs when_option", r->when_value);
    if (r->when_value == NULL)
        return fm_fail(err, FM_INVALID, "when_option '%s': needs when_value", r->when_option);
    const fm_status status =
        check_known(&index, r->when_option, "when_option", &check->options, err);
    if (status != FM_OK)
        return status;
    const fm_option *option = &check->method->options[index];
    return option_has_value(option, r->when_value)
               ? FM_OK
               : fm_fail(err, FM_INVALID, "when_value '%s': option '%s' has no such value",
                         r->when_value, r->when_option);
}

/* Against all others: the one that it replaces, and those that share memory with it. */
static fm_status check_condition(const fm_checked_method *check, const fm_resource *r,
                                 fm_error *err)
{
    const fm_resource *replaced = NULL;
    if (r->when_option == NULL && r->when_value == NULL)
        return FM_OK;
    if (check_condition_names(check, r, err) != FM_OK)
        return FM_INVALID;
    for (size_t i = 0; i < check->resources.count; i++) {
        const fm_resource *other = &check->method->resources[i];
        if (strcmp(other->name, r->name) == 0 && other->when_option == NULL)
            replaced = other;
        if (other->shares != NULL && strcmp(other->shares, r->name) == 0)
            return fm_fail(err, FM_INVALID, "when_option: '%s' shares its memory", other->name);
    }
    if (replaced == NULL)
        return fm_fail(err, FM_INVALID,
                       "when_option: no resource of this name without a condition, which it "
                       "replaces");
    if (!are_sized_alike(r, replaced) || !is_alone(r) || !is_alone(replaced))
        return fm_fail(err, FM_INVALID,
                       "when_option: it and what it replaces need a fixed size or one overflow, "
                       "memory of their own, and one copy");
    return FM_OK;
}

/* Of one name there is one resource, or one for each of some values of an option. */
static fm_status check_once(const fm_checked_method *check, size_t index, fm_error *err)
{
    const fm_resource *r = &check->method->resources[index];
    for (size_t i = 0; i < index; i++) {
        const fm_resource *other = &check->method->resources[i];
        if (strcmp(r->name, other->name) != 0)
            continue;
        const bool is_stand_in = r->when_option != NULL && r->when_value != NULL;
        const bool is_another = other->when_option != NULL && other->when_value != NULL;
        if (!is_stand_in && !is_another)
            return fm_fail(err, FM_INVALID, "resources[%zu]: '%s' is there twice", index, r->name);
        if (!is_stand_in || !is_another)
            continue;
        if (strcmp(r->when_option, other->when_option) != 0)
            return fm_fail(err, FM_INVALID, "resource '%s': when_option '%s': another one has '%s'",
                           r->name, r->when_option, other->when_option);
        if (strcmp(r->when_value, other->when_value) == 0)
            return fm_fail(err, FM_INVALID, "resource '%s': when_value '%s' is there twice",
                           r->name, r->when_value);
    }
    return FM_OK;
}

fm_status check_unconditional(const fm_checked_method *check, const char *name, const char *field,
                              fm_error *err)
{
    for (size_t i = 0; i < check->resources.count; i++) {
        const fm_resource *r = &check->method->resources[i];
        if (r->when_option != NULL && strcmp(r->name, name) == 0)
            return fm_fail(err, FM_INVALID,
                           "%s '%s': with another value of '%s' it is another resource", field,
                           name, r->when_option);
    }
    return FM_OK;
}

static fm_status check_resource_name(const fm_checked_method *check, const char *name,
                                     fm_error *err)
{
    const size_t length = strlen(name);
    if (!check_is_word(name, "_") || length >= NAME_MAX_BYTES)
        return fm_fail(err, FM_INVALID, "needs lower-case letters, digits and '_'");
    if (check_is_reserved(name) || strcmp(name, "store") == 0 || strcmp(name, "wanted") == 0)
        return fm_fail(err, FM_INVALID, "a word that GLSL or the runner reserves");
    for (size_t i = 0; i < check->resources.count; i++) {
        const char *other = check->resources.items[i];
        const size_t other_length = strlen(other);
        if (check->method->resources[i].ping_pong && length > other_length &&
            strncmp(name, other, other_length) == 0 &&
            strcmp(name + other_length, "_previous") == 0)
            return fm_fail(err, FM_INVALID, "this is the other copy of '%s'", other);
    }
    return FM_OK;
}

static fm_status check_resource(const fm_checked_method *check, const fm_resource *r, fm_error *err)
{
    const uint64_t used[] = { r->used.per_pixel, r->used.per_fragment, r->used.per_kept };
    fm_status status = check_resource_name(check, r->name, err);
    if (status == FM_OK)
        status = check_range(r->kind, FM_RESOURCE_KIND_COUNT, "kind", err);
    if (status == FM_OK)
        status = check_factors(used, sizeof used / sizeof used[0], "used", err);
    if (status == FM_OK)
        status = r->kind == FM_RESOURCE_BUFFER ? check_buffer(check, r, err)
                                               : check_image(check, r, err);
    return status == FM_OK ? check_condition(check, r, err) : status;
}

fm_status check_resources(const fm_checked_method *check, fm_error *err)
{
    for (size_t i = 0; i < check->resources.count; i++) {
        const fm_resource *r = &check->method->resources[i];
        if (check_once(check, i, err) != FM_OK)
            return FM_INVALID;
        if (check_resource(check, r, err) != FM_OK)
            return fm_error_prefix(err, "resource '%s'", r->name);
    }
    return FM_OK;
}
