#include "stability_csv.h"

#include <stdio.h>
#include <string.h>

#include "base/csv.h"
#include "blame.h"
#include "model/family.h"

static const fm_metric numbers[] = {
    FM_METRIC_FRAGMENTS_WANTED,
    FM_METRIC_MISSING,
    FM_METRIC_DECLARED_TIES,
    FM_METRIC_LOST_TIES,
    FM_METRIC_DECLARED_AT_ONE,
    FM_METRIC_LOST_AT_ONE,
    FM_METRIC_EXTRA,
    FM_METRIC_MISORDERED,
    FM_METRIC_FRAGMENTS_LOST,
    FM_METRIC_SELF_MAX_ABS,
    FM_METRIC_SELF_BEYOND,
    FM_METRIC_TIED_PIXELS,
    FM_METRIC_DISTINCT_IMAGES,
    FM_METRIC_MISSING_MAX,
    FM_METRIC_DISTINCT_FRAGMENTS,
    FM_METRIC_FRAMES_RMSE_MAX,
    FM_METRIC_WRONG_TILES,
    FM_METRIC_RMSE,
    FM_METRIC_MAX_ABS,
};
enum { NUMBER_COUNT = sizeof numbers / sizeof numbers[0], LIST_BYTES = 256 };

/* Names of the bits with blanks between. */
static void list_bits(char list[LIST_BYTES], uint32_t bits, const char *(*name)(unsigned bit))
{
    list[0] = '\0';
    for (unsigned bit = 0; name(bit) != NULL; bit++)
        if ((bits & 1u << bit) != 0)
            snprintf(list + strlen(list), LIST_BYTES - strlen(list), "%s%s",
                     list[0] != '\0' ? " " : "", name(bit));
}

static void add_text(fm_text *csv, const char *text)
{
    csv_add(csv, text);
    text_add(csv, ",");
}

static void add_bits(fm_text *csv, uint32_t bits, const char *(*name)(unsigned bit))
{
    char list[LIST_BYTES];
    list_bits(list, bits, name);
    add_text(csv, list);
}

static void add_case(fm_text *csv, const fm_case_row *row)
{
    add_text(csv, row->id);
    add_text(csv, row->device);
    add_text(csv, row->device_name);
    add_text(csv, !row->is_device_known ? "" : row->is_software ? "1" : "0");
    add_text(csv, row->feed);
    add_text(csv, row->scene);
    add_text(csv, row->order);
    add_text(csv, row->method);
    add_bits(csv, row->look.traits, trait_name);
    add_text(csv, row->options);
    csv_add_real(csv, row->k);
    text_add(csv, ",");
    csv_add_real(csv, row->metric[FM_METRIC_N]);
    text_add(csv, ",");
    add_text(csv, row->status);
}

static void add_blame(fm_text *csv, const fm_blame *blame, const fm_case_row *row)
{
    char words[BLAME_WORDS_BYTES];
    blame_words(words, blame, row);
    add_text(csv, stability_name(blame->verdict));
    add_bits(csv, blame->wrong, wrong_name);
    add_text(csv, words);
    if (blame->verdict == FM_STABILITY_FAILED)
        add_text(csv, row->status);
    else
        add_bits(csv, blame->unexplained, wrong_name);
}

static void add_row(fm_text *csv, const fm_case_row *row)
{
    const fm_blame blame = blame_case(row);
    if (blame.verdict == FM_STABILITY_NONE)
        return;
    add_case(csv, row);
    add_blame(csv, &blame, row);
    for (size_t i = 0; i < NUMBER_COUNT; i++) {
        csv_add_real(csv, row->metric[numbers[i]]);
        text_add(csv, i + 1 < NUMBER_COUNT ? "," : "\n");
    }
}

fm_status stability_csv_add(fm_text *csv, const fm_result_files *results, fm_error *err)
{
    text_add(csv, "case_id,device,device_name,is_software,feed,scene,order,method,traits,options,k,"
                  "n,status,verdict,wrong,reasons,unexplained");
    for (size_t i = 0; i < NUMBER_COUNT; i++)
        text_add(csv, ",%s", fm_metrics[numbers[i]].name);
    text_add(csv, "\n");
    for (size_t i = 0; i < results->count; i++)
        add_row(csv, &results->cases[i]);
    return csv->failed ? fm_fail(err, FM_NO_MEMORY, "stability.csv") : FM_OK;
}
