#include <jansson.h>
#include <math.h>
#include <stdlib.h>

#include "compare/comparison.h"
#include "night.h"

static json_t *finding_json(const fm_finding *finding, const fm_result_files *now)
{
    char name[FM_COMPARED_NAME_BYTES], text[sizeof finding->text];
    const fm_case_row *row = &now->cases[finding->case_index];
    compared_name(name, row);
    text_make_utf8(name);
    snprintf(text, sizeof text, "%s", finding->text);
    text_make_utf8(text);
    return json_pack("{s:s, s:s, s:s, s:s, s:s, s:b, s:b}", "kind",
                     finding_kind_name(finding->kind), "case", name, "case_id", row->id, "method",
                     row->method, "text", text, "confirmed", finding->is_confirmed, "dismissed",
                     finding->is_dismissed);
}

fm_status night_add_json(fm_text *json, const fm_night_result *night, fm_error *err)
{
    json_t *findings = json_array();
    int failed = findings == NULL;
    for (size_t i = 0; i < night->count && !failed; i++)
        failed =
            json_array_append_new(findings, finding_json(&night->findings[i], night->desc->now));
    json_t *all = json_pack(
        "{s:i, s:s, s:I, s:I, s:I, s:I, s:I, s:I, s:o, s:o}", "schema", 1, "verdict",
        night->alarms > 0         ? "alarm"
        : night->new_failures > 0 ? "failed"
                                  : "quiet",
        "cases", (json_int_t)night->desc->now->count, "alarms", (json_int_t)night->alarms,
        "new_failures", (json_int_t)night->new_failures, "newer_nights",
        (json_int_t)night->newer.count, "early", (json_int_t)night->early, "launches_needed",
        (json_int_t)night->launches_needed, "noisiest",
        isnan(night->noisiest) ? json_null() : json_real(night->noisiest), "findings", findings);
    char *text = failed || all == NULL ? NULL : json_dumps(all, JSON_INDENT(2));
    if (text != NULL)
        text_add(json, "%s\n", text);
    json_decref(all);
    const bool is_made = text != NULL && !json->failed;
    free(text);
    return is_made ? FM_OK : fm_fail(err, FM_NO_MEMORY, "no memory for %zu findings", night->count);
}
