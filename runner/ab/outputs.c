#include "outputs.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>

#include "results/answer_check.h"

const char *ab_outputs_name(ab_outputs outputs)
{
    static const char *const names[] = {
        [AB_OUTPUTS_WORSE] = "worse",
        [AB_OUTPUTS_DIFFER] = "differ",
        [AB_OUTPUTS_EQUAL] = "equal",
        [AB_OUTPUTS_BETTER] = "better",
    };
    _Static_assert(sizeof names / sizeof names[0] == AB_OUTPUTS_COUNT, "one name each");
    return names[outputs];
}

/* What was found so far. */
typedef struct findings {
    fm_text *changes;
    bool is_worse, is_better, differs;
} findings;

static void begin_change(findings *found, const char *name)
{
    text_add(found->changes, "%s%s ", found->changes->length > 0 ? "; " : "", name);
}

/* order: below 0: NEW is worse; above 0: better; 0: nobody can say. */
static void note(findings *found, int order)
{
    found->is_worse = found->is_worse || order < 0;
    found->is_better = found->is_better || order > 0;
    found->differs = found->differs || order == 0;
}

static void compare_status(findings *found, fm_case_status base, fm_case_status now)
{
    if (base == now)
        return;
    begin_change(found, "status");
    text_add(found->changes, "%s -> %s", case_status_name(base), case_status_name(now));
    note(found, now > base ? -1 : 1);
}

static double metric_of(const ab_output_side *side, fm_metric metric)
{
    double value = NAN;
    const json_t *kept = json_object_get(side->result->metrics, fm_metrics[metric].name);
    if (kept == NULL || !answer_value(&value, kept))
        return NAN;
    return value;
}

static int order_of(const fm_metric_info *info, double base, double now)
{
    if (info->better == FM_BETTER_NEITHER)
        return 0;
    return (now < base) == (info->better == FM_BETTER_LESS) ? 1 : -1;
}

static void compare_metric(findings *found, fm_metric metric, const ab_output_side *base,
                           const ab_output_side *now)
{
    const fm_metric_info *info = &fm_metrics[metric];
    const double before = metric_of(base, metric), after = metric_of(now, metric);
    const double rounding = info->range == FM_RANGE_ERROR ? AB_ERROR_ROUNDING : 0.0;
    if (isnan(before) || isnan(after) || before == after || fabs(after - before) <= rounding)
        return;
    begin_change(found, info->name);
    text_add(found->changes, "%.15g -> %.15g", before, after);
    note(found, order_of(info, before, after));
}

/* Levels (PSNR, SSIM) follow from errors that are compared; of what a device rounds, the errors
 * that are told in ulps say nothing of the method. */
static bool is_compared(fm_metric metric, bool repeats)
{
    const fm_metric_info *info = &fm_metrics[metric];
    if (info->of != FM_OF_CASE || info->is_measured || info->range == FM_RANGE_LEVEL ||
        metric == FM_METRIC_IMAGE_ULP_MAX)
        return false;
    return repeats || info->range == FM_RANGE_BYTES || metric == FM_METRIC_N ||
           metric == FM_METRIC_FRAGMENTS_GENERATED || metric == FM_METRIC_NONEMPTY_PIXELS ||
           metric == FM_METRIC_TRUTH_DIGEST;
}

static bool repeats(const ab_output_side *side)
{
    return !side->is_racy && side->result->image_count <= 1;
}

static void compare_images(findings *found, const fm_case_result *base, const fm_case_result *now)
{
    if (base->image_count != 1 || now->image_count != 1 || base->images[0] == now->images[0])
        return;
    begin_change(found, "image");
    text_add(found->changes, "%016" PRIx64 " -> %016" PRIx64, base->images[0], now->images[0]);
    note(found, 0);
}

ab_outputs outputs_compare(fm_text *changes, const ab_output_side *base, const ab_output_side *now)
{
    findings found = { .changes = changes };
    const bool both_repeat = repeats(base) && repeats(now);
    compare_status(&found, base->result->status, now->result->status);
    for (int i = 0; i < FM_METRIC_COUNT; i++)
        if (is_compared((fm_metric)i, both_repeat))
            compare_metric(&found, (fm_metric)i, base, now);
    if (both_repeat)
        compare_images(&found, base->result, now->result);
    if (found.is_worse)
        return AB_OUTPUTS_WORSE;
    if (found.differs)
        return AB_OUTPUTS_DIFFER;
    return found.is_better ? AB_OUTPUTS_BETTER : AB_OUTPUTS_EQUAL;
}
