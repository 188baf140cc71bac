/* What a pass draws into: targets, depth and stencil, and their samples. */
#include <inttypes.h>
#include <string.h>

#include "check_method.h"
#include "model/formats.h"

enum { MAX_STENCIL = 255 };

/* FM_INVALID unless name is an image of the wanted kind. */
static fm_status check_attachment(const fm_resource **image, const fm_checked_method *check,
                                  const char *name, bool wants_depth, const char *field,
                                  fm_error *err)
{
    size_t index;
    const fm_status status = check_known(&index, name, field, &check->resources, err);
    if (status != FM_OK)
        return status;
    *image = &check->method->resources[index];
    if (check_unconditional(check, name, field, err) != FM_OK)
        return FM_INVALID;
    if ((*image)->kind != FM_RESOURCE_IMAGE)
        return fm_fail(err, FM_INVALID, "%s '%s': is a buffer, not an image", field, name);
    if (format_has_depth((*image)->format) != wants_depth)
        return fm_fail(err, FM_INVALID, "%s '%s': needs a %s format", field, name,
                       wants_depth ? "depth" : "colour");
    return FM_OK;
}

/* Samples of an image: constant + per_k * k + the option's number. */
typedef struct sample_formula {
    uint32_t constant, per_k;
    const char *option; /* all zero: none yet */
} sample_formula;

static sample_formula samples_of(const fm_resource *image)
{
    const char *option = image->samples_option != NULL ? image->samples_option : "";
    const bool is_default = image->samples == 0 && image->samples_per_k == 0 && *option == '\0';
    return (sample_formula){ is_default ? 1 : image->samples, image->samples_per_k, option };
}

/* All attachments of a pass have the same samples, whatever k is. */
static fm_status check_samples(sample_formula *samples, const fm_resource *image, fm_error *err)
{
    const sample_formula own = samples_of(image);
    const bool is_first = samples->option == NULL;
    if (!is_first && (samples->constant != own.constant || samples->per_k != own.per_k))
        return fm_fail(err, FM_INVALID,
                       "target '%s': %" PRIu32 " + %" PRIu32 " k samples, the others have %" PRIu32
                       " + %" PRIu32 " k",
                       image->name, own.constant, own.per_k, samples->constant, samples->per_k);
    if (!is_first && strcmp(samples->option, own.option) != 0)
        return fm_fail(err, FM_INVALID,
                       "target '%s': samples of option '%s', the others have those of '%s'",
                       image->name, own.option, samples->option);
    *samples = own;
    return FM_OK;
}

static fm_status check_target(const fm_checked_method *check, const fm_target *target,
                              sample_formula *samples, fm_error *err)
{
    const fm_resource *image = NULL;
    fm_status status = check_attachment(&image, check, target->resource, false, "target", err);
    if (status == FM_OK)
        status = check_range(target->load, FM_LOAD_COUNT, "target load", err);
    if (status == FM_OK)
        status = check_range(target->blend, FM_BLEND_COUNT, "target blend", err);
    if (status != FM_OK)
        return status;
    if (target->blend != FM_BLEND_OFF && format_is_integer(image->format))
        return fm_fail(err, FM_INVALID, "target '%s': integer formats do not blend",
                       target->resource);
    return check_samples(samples, image, err);
}

static fm_status check_targets(const fm_checked_method *check, const fm_pass *pass,
                               sample_formula *samples, fm_error *err)
{
    size_t count;
    fm_status status = check_list(&count, &pass->targets[0].resource, sizeof pass->targets[0],
                                  FM_MAX_TARGETS, "targets", err);
    for (size_t i = 0; status == FM_OK && i < count; i++)
        status = check_target(check, &pass->targets[i], samples, err);
    return status;
}

static fm_status check_state_ranges(const fm_state *s, fm_error *err)
{
    fm_status status = check_range(s->depth_stencil_load, FM_LOAD_COUNT, "depth_stencil_load", err);
    if (status == FM_OK)
        status = check_range(s->depth_test, FM_COMPARE_COUNT, "depth_test", err);
    if (status == FM_OK)
        status = check_range(s->stencil_test, FM_COMPARE_COUNT, "stencil_test", err);
    if (status == FM_OK)
        status = check_range(s->stencil_fail, FM_STENCIL_OP_COUNT, "stencil_fail", err);
    if (status == FM_OK)
        status = check_range(s->stencil_depth_fail, FM_STENCIL_OP_COUNT, "stencil_depth_fail", err);
    if (status == FM_OK)
        status = check_range(s->stencil_pass, FM_STENCIL_OP_COUNT, "stencil_pass", err);
    if (status == FM_OK)
        status = check_range(s->stencil_reference, MAX_STENCIL + 1, "stencil_reference", err);
    return status;
}

static fm_status check_state(const fm_checked_method *check, const fm_state *s,
                             sample_formula *samples, fm_error *err)
{
    const fm_resource *image = NULL;
    fm_status status = check_state_ranges(s, err);
    if (status != FM_OK)
        return status;
    if (s->depth_write && s->depth_test == FM_COMPARE_OFF)
        return fm_fail(err, FM_INVALID,
                       "depth_write: needs depth_test, FM_COMPARE_ALWAYS at least");
    if (s->depth_stencil == NULL) {
        if (s->depth_test != FM_COMPARE_OFF || s->stencil_test != FM_COMPARE_OFF)
            return fm_fail(err, FM_INVALID, "depth_test, stencil_test: need depth_stencil");
        return FM_OK;
    }
    status = check_attachment(&image, check, s->depth_stencil, true, "depth_stencil", err);
    if (status != FM_OK)
        return status;
    if (s->stencil_test != FM_COMPARE_OFF && image->format != FM_FORMAT_D32F_S8)
        return fm_fail(err, FM_INVALID, "stencil_test: '%s' needs FM_FORMAT_D32F_S8",
                       s->depth_stencil);
    return check_samples(samples, image, err);
}

fm_status check_attachments(const fm_checked_method *check, const fm_pass *pass, fm_error *err)
{
    sample_formula samples = { 0 };
    const fm_status status = check_targets(check, pass, &samples, err);
    return status == FM_OK ? check_state(check, &pass->state, &samples, err) : status;
}
