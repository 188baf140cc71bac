#include <math.h>

#include "base/csv.h"
#include "comparison.h"

static void add_text(fm_text *csv, const char *text)
{
    csv_add(csv, text);
    text_add(csv, ",");
}

static void add_number(fm_text *csv, double value)
{
    csv_add_real(csv, value);
    text_add(csv, ",");
}

static void add_interval(fm_text *csv, const fm_interval *interval)
{
    add_number(csv, interval->median);
    add_number(csv, interval->low);
    add_number(csv, interval->high);
}

/* What names it, from whichever run has it. */
static void add_case(fm_text *csv, const fm_pair *pair)
{
    const fm_case_row *row = pair->base != NULL ? pair->base : pair->now;
    add_text(csv, row->method);
    add_text(csv, row->options);
    add_number(csv, row->k);
    add_number(csv, row->metric[FM_METRIC_N]);
    add_text(csv, row->scene);
    add_text(csv, row->device);
    add_text(csv, row->feed);
    add_number(csv, row->width_px);
    add_number(csv, row->height_px);
    add_text(csv, pair->base != NULL ? pair->base->id : "");
    add_text(csv, pair->now != NULL ? pair->now->id : "");
    add_text(csv, pair->base != NULL ? pair->base->status : "");
    add_text(csv, pair->now != NULL ? pair->now->status : "");
}

static void add_numbers(fm_text *csv, const fm_pair *pair, fm_metric metric)
{
    add_number(csv, pair->base != NULL ? pair->base->metric[metric] : NAN);
    add_number(csv, pair->now != NULL ? pair->now->metric[metric] : NAN);
}

/* Memory and the errors that say most, also where they are equal. */
static const fm_metric shown[] = { FM_METRIC_BYTES_ALLOCATED, FM_METRIC_MISSING, FM_METRIC_EXTRA,
                                   FM_METRIC_RMSE, FM_METRIC_TOTAL_RMSE };
enum { SHOWN = sizeof shown / sizeof shown[0] };

/* judged: the columns between what names a case and what is exact. */
static void add_header(fm_text *csv, const char *judged)
{
    text_add(csv,
             "method,options,k,n,scene,device,feed,width_px,height_px,case_id_base,"
             "case_id_new,status_base,status_new,%s",
             judged);
    for (size_t i = 0; i < SHOWN; i++)
        text_add(csv, "%s_base,%s_new,", fm_metrics[shown[i]].name, fm_metrics[shown[i]].name);
    text_add(csv, "exact,other_code\n");
}

static const char *where(const fm_pair *pair)
{
    return pair->base != NULL ? "only in BASE" : "only in NEW";
}

/* compared NULL: the case is in one run alone. */
static void add_times(fm_text *csv, const fm_pair *pair, const fm_compared *compared,
                      const char *quantity)
{
    static const fm_interval none = { NAN, NAN, NAN };
    add_text(csv, quantity);
    add_interval(csv, compared != NULL ? &compared->base : &none);
    add_interval(csv, compared != NULL ? &compared->now : &none);
    add_interval(csv, compared != NULL ? &compared->ratio : &none);
    add_text(csv, compared != NULL ? compared_verdict_name(compared->verdict) : "");
    add_text(csv, compared != NULL ? compared->why : where(pair));
}

/* The same. */
static void add_exact(fm_text *csv, const fm_pair *pair, const fm_compared *compared)
{
    fm_text changes = { 0 };
    for (size_t i = 0; i < SHOWN; i++)
        add_numbers(csv, pair, shown[i]);
    if (compared != NULL)
        compared_add_changes(&changes, compared);
    add_text(csv, changes.length > 0 ? changes.bytes : compared != NULL ? "equal" : "");
    csv_add(csv, compared != NULL ? compared->code : "");
    text_add(csv, "\n");
    csv->failed |= changes.failed;
    text_free(&changes);
}

/* quantity NULL: no times. */
static void add_row(fm_text *csv, const fm_pair *pair, const fm_compared *compared,
                    const char *quantity)
{
    add_case(csv, pair);
    if (quantity != NULL)
        add_times(csv, pair, compared, quantity);
    else
        add_text(csv, compared != NULL ? exact_verdict_name(exact_verdict(&compared->changes))
                                       : where(pair));
    add_exact(csv, pair, compared);
}

static void add_rows(fm_text *csv, const fm_comparison *comparison, const char *quantity)
{
    for (size_t i = 0; i < comparison->count; i++)
        add_row(csv, &comparison->cases[i].pair, &comparison->cases[i], quantity);
    for (size_t i = 0; i < comparison->pairs.count; i++)
        if (comparison->pairs.items[i].base == NULL || comparison->pairs.items[i].now == NULL)
            add_row(csv, &comparison->pairs.items[i], NULL, quantity);
}

void comparison_add_csv(fm_text *csv, const fm_comparison *comparison)
{
    char quantity[128];
    quantity_title(quantity, &comparison->quantity);
    add_header(csv, "quantity,base,base_low,base_high,new,new_low,new_high,ratio,ratio_low,"
                    "ratio_high,verdict,why,");
    add_rows(csv, comparison, quantity);
}

void comparison_add_exact_csv(fm_text *csv, const fm_comparison *comparison)
{
    add_header(csv, "verdict,");
    add_rows(csv, comparison, NULL);
}
