#include "tradeoff_csv.h"

#include <math.h>
#include <stdlib.h>

#include "base/csv.h"

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

static void add_row(fm_text *csv, const fm_group *group, const fm_place *places, size_t index,
                    const fm_error_kind *kind)
{
    const fm_case_row *row = group->cases[index];
    const fm_place *place = &places[index];
    add_text(csv, group->name);
    add_text(csv, row->scene);
    add_text(csv, row->device);
    add_text(csv, row->feed);
    add_text(csv, row->method);
    add_text(csv, row->options);
    add_number(csv, row->k);
    add_number(csv, row->metric[FM_METRIC_N]);
    add_text(csv, row->id);
    add_text(csv, row->status);
    add_text(csv, fm_metrics[kind->metric].name);
    add_number(csv, error_kind_of(kind, row));
    add_number(csv, row->metric[FM_METRIC_TRUNCATION_RMSE]);
    add_number(csv, row->metric[FM_METRIC_RMSE]);
    add_number(csv, row->metric[FM_METRIC_FRAME_MS]);
    add_number(csv, row->low[FM_METRIC_FRAME_MS]);
    add_number(csv, row->high[FM_METRIC_FRAME_MS]);
    add_number(csv, row->metric[FM_METRIC_BYTES_ALLOCATED]);
    add_text(csv, standing_name(place->standing));
    csv_add(csv,
            place->standing == FM_STANDING_DOMINATED ? group->cases[place->beaten_by]->id : "");
    text_add(csv, "\n");
}

fm_status tradeoff_csv_add(fm_text *csv, const fm_groups *groups, const fm_error_kind *kind,
                           fm_error *err)
{
    text_add(csv, "workload,scene,device,feed,method,options,k,n,case_id,status,error_metric,error,"
                  "truncation_rmse,rmse,frame_ms,frame_ms_low,frame_ms_high,bytes_allocated,"
                  "standing,beaten_by\n");
    for (size_t i = 0; i < groups->count; i++) {
        const fm_group *group = &groups->groups[i];
        fm_place *places = calloc(group->count + 1, sizeof *places);
        const bool is_made = places != NULL && standings_make(places, group, kind);
        for (size_t c = 0; is_made && c < group->count; c++)
            if (standing_has_point(group->cases[c], kind))
                add_row(csv, group, places, c, kind);
        free(places);
        if (!is_made)
            return fm_fail(err, FM_NO_MEMORY, "tradeoff.csv");
    }
    return csv->failed ? fm_fail(err, FM_NO_MEMORY, "tradeoff.csv") : FM_OK;
}
