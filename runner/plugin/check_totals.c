/* Totals of a descriptor: numbers that the runner reads back. */
#include <inttypes.h>
#include <string.h>

#include "check_method.h"

/* A total that is read from a buffer. */
static fm_status check_source(const fm_checked_method *check, const fm_total *total, fm_error *err)
{
    size_t index;
    const fm_status status =
        check_known(&index, total->resource, "resource", &check->resources, err);
    if (status != FM_OK)
        return status;
    const fm_resource *r = &check->method->resources[index];
    if (check_unconditional(check, r->name, "resource", err) != FM_OK)
        return FM_INVALID;
    if (r->kind != FM_RESOURCE_BUFFER || r->element != FM_ELEMENT_UINT)
        return fm_fail(err, FM_INVALID, "resource '%s': needs a buffer of FM_ELEMENT_UINT",
                       total->resource);
    if (total->sum && total->index != 0)
        return fm_fail(err, FM_INVALID, "index: not with sum");
    const fm_extent only_constant = { .constant = r->extent.constant };
    if (memcmp(&r->extent, &only_constant, sizeof only_constant) == 0 &&
        total->index >= r->extent.constant)
        return fm_fail(err, FM_INVALID, "index: %" PRIu64 ": '%s' has %" PRIu64 " elements",
                       total->index, total->resource, r->extent.constant);
    return FM_OK;
}

static bool is_same(const char *name, const char *other)
{
    return other != NULL && strcmp(name, other) == 0;
}

/* What needs the total before the frame's end; NULL: nothing. */
static const char *needed_early(const fm_method_desc *method, const char *total)
{
    for (int i = 0; i < FM_MAX_PASSES && method->passes[i].name != NULL; i++)
        if (is_same(total, method->passes[i].count_total))
            return "count_total";
    for (int i = 0; i < FM_MAX_RESOURCES && method->resources[i].name != NULL; i++)
        if (is_same(total, method->resources[i].overflow))
            return "overflow";
    return method->after != NULL ? "after" : is_same(total, method->k_total) ? "k_total" : NULL;
}

static fm_status check_late(const fm_checked_method *check, const fm_total *total, fm_error *err)
{
    const char *early = needed_early(check->method, total->name);
    size_t index;
    if (!total->late)
        return FM_OK;
    if (total->resource == NULL)
        return fm_fail(err, FM_INVALID, "late: needs resource");
    if (check_known(&index, total->resource, "resource", &check->resources, err) != FM_OK)
        return FM_INVALID;
    if (check->method->loops[0].first != NULL)
        return fm_fail(err, FM_INVALID, "late: not with loops, which may write it again");
    if (check->method->resources[index].shares != NULL)
        return fm_fail(err, FM_INVALID, "late: resource '%s' shares its memory", total->resource);
    if (early != NULL)
        return fm_fail(err, FM_INVALID, "late: not with %s, which needs it during the frame",
                       early);
    return FM_OK;
}

static fm_status check_total(const fm_checked_method *check, const fm_total *total, fm_error *err)
{
    size_t index;
    if (check_late(check, total, err) != FM_OK)
        return FM_INVALID;
    if (!check_is_word(total->name, "_-"))
        return fm_fail(err, FM_INVALID, "needs lower-case letters, digits, '-' and '_'");
    if (total->pass == NULL)
        return fm_fail(err, FM_INVALID, "pass: missing: after which pass it is read");
    const fm_status status = check_known(&index, total->pass, "pass", &check->passes, err);
    if (status != FM_OK)
        return status;
    if (check->method->passes[index].narrow_only)
        return fm_fail(err, FM_INVALID, "pass '%s': is left out on some devices", total->pass);
    if (total->resource != NULL)
        return check_source(check, total, err);
    if (total->sum || total->index != 0)
        return fm_fail(err, FM_INVALID, "sum, index: need resource");
    if (check->method->passes[index].kind != FM_PASS_SCENE)
        return fm_fail(
            err, FM_INVALID,
            "pass '%s': samples are counted in scene passes only, and resource is not set",
            total->pass);
    return FM_OK;
}

static fm_status check_k_total(const fm_checked_method *check, fm_error *err)
{
    size_t index;
    if (check->method->k_total == NULL)
        return FM_OK;
    if (check->method->keeps != FM_KEEPS_K_NEAREST)
        return fm_fail(err, FM_INVALID, "k_total '%s': only with FM_KEEPS_K_NEAREST",
                       check->method->k_total);
    return check_known(&index, check->method->k_total, "k_total", &check->totals, err);
}

fm_status check_totals(const fm_checked_method *check, fm_error *err)
{
    for (size_t i = 0; i < check->totals.count; i++)
        if (check_total(check, &check->method->totals[i], err) != FM_OK)
            return fm_error_prefix(err, "total '%s'", check->totals.items[i]);
    return check_k_total(check, err);
}
