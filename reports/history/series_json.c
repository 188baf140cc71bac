#include <jansson.h>
#include <math.h>
#include <stdlib.h>

#include "series.h"

/* JSON has no number that is none. */
static json_t *number(double value)
{
    return isfinite(value) ? json_real(value) : json_null();
}

static json_t *night_json(const fm_series_night *night)
{
    return json_pack("{s:s, s:s, s:s, s:s, s:s, s:s, s:s, s:[s,s,s,s], s:o, s:o, s:o, s:o, s:o,"
                     " s:I, s:o, s:o, s:o, s:o, s:o, s:o}",
                     "run_id", night->run_id, "started", night->started, "git_commit",
                     night->git_commit, "case_id", night->case_id, "status", night->status, "noisy",
                     night->noisy, "image", night->image, "code", night->code[0], night->code[1],
                     night->code[2], night->code[3], "frame_ms", number(night->frame_ms.median),
                     "frame_ms_low", number(night->frame_ms.low), "frame_ms_high",
                     number(night->frame_ms.high), "ratio", number(night->centre.ratio),
                     "ratio_standard_error", number(night->centre.standard_error), "launches",
                     (json_int_t)night->centre.launches, "bytes_allocated",
                     number(night->bytes_allocated), "missing", number(night->missing), "extra",
                     number(night->extra), "misordered", number(night->misordered), "max_abs",
                     number(night->max_abs), "total_rmse", number(night->total_rmse));
}

static json_t *alarm_json(const fm_alarm *alarm)
{
    return json_pack("{s:s, s:o, s:o, s:f, s:I, s:I, s:I}", "verdict",
                     alarm_verdict_name(alarm->verdict), "factor", number(alarm->factor), "p",
                     number(alarm->p), "level", alarm->level, "recent", (json_int_t)alarm->recent,
                     "before", (json_int_t)alarm->before, "needed", (json_int_t)alarm->needed);
}

static json_t *series_json(const fm_series *series, const char *reference)
{
    json_t *nights = json_array(), *steps = json_array();
    for (size_t i = 0; i < series->count; i++)
        json_array_append_new(nights, night_json(&series->nights[i]));
    for (size_t i = 0; i < series->step_count; i++)
        json_array_append_new(steps, json_pack("{s:s, s:f, s:f}", "started",
                                               series->nights[series->steps[i].index].started,
                                               "factor", exp(series->steps[i].shift), "p_adjusted",
                                               series->steps[i].p_adjusted));
    return json_pack("{s:s, s:s, s:s, s:s, s:o, s:s, s:o, s:o, s:o}", "case", series->title,
                     "method", series->method, "machine", series->machine, "device_name",
                     series->device_name, "n", number(series->n), "reference",
                     reference != NULL ? reference : "floor", "nights", nights, "steps", steps,
                     "alarm", alarm_json(&series->alarm));
}

fm_status history_add_series_json(fm_text *json, const fm_series_list *list, const char *reference,
                                  fm_error *err)
{
    json_t *all = json_array();
    int failed = all == NULL;
    for (size_t i = 0; i < list->count && !failed; i++)
        failed = json_array_append_new(all, series_json(&list->items[i], reference));
    char *text = failed ? NULL : json_dumps(all, JSON_INDENT(2));
    if (text != NULL)
        text_add(json, "%s\n", text);
    json_decref(all);
    const bool is_made = text != NULL && !json->failed;
    free(text);
    return is_made ? FM_OK
                   : fm_fail(err, FM_NO_MEMORY, "no memory for JSON of %zu cases", list->count);
}
