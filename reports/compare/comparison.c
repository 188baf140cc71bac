#include "comparison.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "read/group.h"
#include "read/interval.h"

static const char *const verdict_names[] = {
    [FM_COMPARED_SLOWER] = "slower", [FM_COMPARED_UNCLEAR] = "unclear", [FM_COMPARED_SAME] = "same",
    [FM_COMPARED_FASTER] = "faster", [FM_COMPARED_UNTIMED] = "untimed",
};
_Static_assert(sizeof verdict_names / sizeof verdict_names[0] == FM_COMPARED_COUNT,
               "one name a verdict");

const char *compared_verdict_name(fm_compared_verdict verdict)
{
    return verdict_names[verdict];
}

/* What keeps the ratio from being judged; NULL: nothing. */
static const char *find_doubt(const fm_compared *compared)
{
    if (compared->pair.base->noisy[0] != '\0')
        return "BASE's row is noisy";
    if (compared->pair.now->noisy[0] != '\0')
        return "NEW's row is noisy";
    if (!interval_is_known(&compared->ratio))
        return "one launch has no interval";
    return NULL;
}

static fm_compared_verdict judge(const char **why, const fm_compared *compared,
                                 const fm_comparison *of)
{
    const fm_interval *ratio = &compared->ratio;
    const double most = 1.0 + of->band, least = 1.0 / most;
    *why = of->quantity.over == FM_OVER_NOTHING ? "no time in both"
                                                : "no time, or none to divide it by, in both";
    if (isnan(ratio->median))
        return FM_COMPARED_UNTIMED;
    *why = find_doubt(compared);
    if (*why != NULL)
        return FM_COMPARED_UNCLEAR;
    *why = "";
    if (ratio->low >= least && ratio->high <= most)
        return FM_COMPARED_SAME;
    if (ratio->low > 1.0 && ratio->median > most)
        return FM_COMPARED_SLOWER;
    if (ratio->high < 1.0 && ratio->median < least)
        return FM_COMPARED_FASTER;
    *why = "the interval is too wide";
    return FM_COMPARED_UNCLEAR;
}

static fm_status compare_case(fm_compared *compared, const fm_comparison *of, const fm_pair *pair,
                              fm_error *err)
{
    compared->pair = *pair;
    compared->base = quantity_of(&of->quantity, of->base_run, pair->base);
    compared->now = quantity_of(&of->quantity, of->now_run, pair->now);
    compared->ratio = interval_ratio(compared->now, compared->base);
    if (!isfinite(compared->ratio.median))
        compared->ratio = (fm_interval){ NAN, NAN, NAN };
    compared->verdict = judge(&compared->why, compared, of);
    exact_code(compared->code, pair);
    const fm_status status =
        exact_compare(&compared->changes, pair, of->base_run, of->now_run, err);
    return status == FM_OK
               ? exact_add_image(&compared->changes, pair,
                                 of->base_images.hashes[pair->base - of->base_run->cases],
                                 of->now_images.hashes[pair->now - of->now_run->cases], err)
               : status;
}

/* Smaller is worse. */
static int rank_of(const fm_compared *compared)
{
    static const int ranks[] = {
        [FM_COMPARED_SLOWER] = 1, [FM_COMPARED_UNCLEAR] = 3, [FM_COMPARED_SAME] = 4,
        [FM_COMPARED_FASTER] = 5, [FM_COMPARED_UNTIMED] = 6,
    };
    if (compared->pair.base->outcome != compared->pair.now->outcome)
        return 0;
    if (compared->verdict != FM_COMPARED_SLOWER && compared->changes.count > 0)
        return 2;
    return ranks[compared->verdict];
}

static int compare_badness(const void *left, const void *right)
{
    const fm_compared *a = left, *b = right;
    const int ranks = rank_of(a) - rank_of(b);
    const double x = isnan(a->ratio.median) ? 0.0 : a->ratio.median;
    const double y = isnan(b->ratio.median) ? 0.0 : b->ratio.median;
    if (ranks != 0 || x != y)
        return ranks != 0 ? ranks : (x < y) - (x > y);
    return (a->pair.base > b->pair.base) - (a->pair.base < b->pair.base); /* one array */
}

static fm_status compare_cases(fm_comparison *comparison, fm_error *err)
{
    fm_status status = FM_OK;
    for (size_t i = 0; i < comparison->pairs.count; i++) {
        comparison->only_base += comparison->pairs.items[i].now == NULL;
        comparison->only_now += comparison->pairs.items[i].base == NULL;
    }
    const size_t both = comparison->pairs.count - comparison->only_base - comparison->only_now;
    if (both == 0)
        return fm_fail(err, FM_UNSUPPORTED, "%s and %s have no case in common",
                       comparison->base_run->directory, comparison->now_run->directory);
    comparison->cases = calloc(both, sizeof *comparison->cases);
    if (comparison->cases == NULL)
        return fm_fail(err, FM_NO_MEMORY, "no memory for %zu cases", both);
    for (size_t i = 0; i < comparison->pairs.count && status == FM_OK; i++) {
        const fm_pair *pair = &comparison->pairs.items[i];
        if (pair->base != NULL && pair->now != NULL)
            status = compare_case(&comparison->cases[comparison->count++], comparison, pair, err);
    }
    qsort(comparison->cases, comparison->count, sizeof *comparison->cases, compare_badness);
    return status;
}

fm_status comparison_make(fm_comparison *comparison, const fm_comparison_desc *desc, fm_error *err)
{
    *comparison =
        (fm_comparison){ .base_run = desc->base, .now_run = desc->now, .band = desc->band };
    const fm_machines_desc machines = { desc->base, desc->now, &comparison->pairs };
    fm_status status = join_cases(&comparison->pairs, desc->base, desc->now, err);
    if (status == FM_OK)
        status = machines_compare(&comparison->machines, &machines, err);
    if (status == FM_OK)
        status = quantity_choose(&comparison->quantity, &desc->quantity, &comparison->machines,
                                 desc->base, desc->now, err);
    if (status == FM_OK)
        status = images_read(&comparison->base_images, desc->base, err);
    if (status == FM_OK)
        status = images_read(&comparison->now_images, desc->now, err);
    return status == FM_OK ? compare_cases(comparison, err) : status;
}

void comparison_free(fm_comparison *comparison)
{
    for (size_t i = 0; i < comparison->count; i++)
        exact_free(&comparison->cases[i].changes);
    free(comparison->cases);
    quantity_free(&comparison->quantity);
    images_free(&comparison->base_images);
    images_free(&comparison->now_images);
    join_free(&comparison->pairs);
    machines_free(&comparison->machines);
    *comparison = (fm_comparison){ 0 };
}

size_t comparison_verdicts(const fm_comparison *comparison, fm_compared_verdict verdict)
{
    size_t count = 0;
    for (size_t i = 0; i < comparison->count; i++)
        count += comparison->cases[i].verdict == verdict;
    return count;
}

size_t comparison_changed(const fm_comparison *comparison)
{
    size_t count = 0;
    for (size_t i = 0; i < comparison->count; i++)
        count += comparison->cases[i].changes.count > 0;
    return count;
}

size_t comparison_exact(const fm_comparison *comparison, fm_exact_verdict verdict)
{
    size_t count = 0;
    for (size_t i = 0; i < comparison->count; i++)
        count += exact_verdict(&comparison->cases[i].changes) == verdict;
    return count;
}

void compared_name(char name[FM_COMPARED_NAME_BYTES], const fm_case_row *row)
{
    char title[96], k[32] = "", n[32] = "";
    group_series_title(title, row, NULL);
    if (!isnan(row->k))
        snprintf(k, sizeof k, ", k %.9g", row->k);
    if (!isnan(row->metric[FM_METRIC_N]))
        snprintf(n, sizeof n, ", n %.9g", row->metric[FM_METRIC_N]);
    snprintf(name, FM_COMPARED_NAME_BYTES, "%s%s%s, %.48s, %.24s, %.24s, %.9g x %.9g", title, k, n,
             row->scene, row->device, row->feed, row->width_px, row->height_px);
}

void compared_add_changes(fm_text *text, const fm_compared *compared)
{
    for (size_t i = 0; i < compared->changes.count; i++) {
        const fm_change *change = &compared->changes.items[i];
        text_add(text, "%s%s %s -> %s", i > 0 ? "; " : "", change->name,
                 change->base[0] != '\0' ? change->base : "(empty)",
                 change->now[0] != '\0' ? change->now : "(empty)");
    }
}
