#include "case_table.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "html.h"

/* A metric's name and meaning are its own; other columns have them here. */
static const struct {
    const char *title, *help;
    fm_metric metric; /* where title is NULL */
} columns[] = {
    { "&#9679;", "filled: on the frontier, clearly faster than all with no more error; empty: tied",
      0 },
    { "method", "as its paper names it", 0 },
    { "k", "fragments kept per pixel", 0 },
    { .metric = FM_METRIC_N },
    { "status", "ok, or why there is no time", 0 },
    { .metric = FM_METRIC_FRAME_MS },
    { "interval", "95 % interval of frame_ms, by launches; none of one launch", 0 },
    { .metric = FM_METRIC_TIMES_FLOOR },
    { "interval", "95 % interval of times_floor, by launches; none of one launch", 0 },
    { .metric = FM_METRIC_BYTES_ALLOCATED },
    { .metric = FM_METRIC_MISSING },
    { .metric = FM_METRIC_EXTRA },
    { .metric = FM_METRIC_MISORDERED },
    { .metric = FM_METRIC_RMSE },
    { .metric = FM_METRIC_TOTAL_RMSE },
    { .metric = FM_METRIC_TRUNCATION_RMSE },
    { "message", "", 0 }, /* last: left out where none has one */
};
enum { COLUMN_COUNT = sizeof columns / sizeof columns[0] };

/* "53.2 MiB", "640 B". */
static void format_bytes(char text[24], double bytes)
{
    static const char *const units[] = { "B", "KiB", "MiB", "GiB", "TiB" };
    size_t unit = 0;
    while (bytes >= 1024.0 && unit + 1 < sizeof units / sizeof units[0]) {
        bytes /= 1024.0;
        unit++;
    }
    snprintf(text, 24, "%.4g %s", bytes, units[unit]);
}

/* A metric and its interval, if the case was measured. */
static void add_interval(fm_text *page, const fm_case_row *result, fm_metric metric, int digits)
{
    html_add_number(page, digits, result->is_measured ? result->metric[metric] : NAN);
    if (result->is_measured && isfinite(result->low[metric]) && isfinite(result->high[metric]))
        text_add(page, "<td class=n>[%.*g, %.*g]</td>", digits, result->low[metric], digits,
                 result->high[metric]);
    else
        text_add(page, "<td></td>");
}

static void add_memory(fm_text *page, const fm_case_row *result)
{
    char bytes[24];
    if (isnan(result->metric[FM_METRIC_BYTES_ALLOCATED])) {
        text_add(page, "<td></td>");
        return;
    }
    format_bytes(bytes, result->metric[FM_METRIC_BYTES_ALLOCATED]);
    text_add(page, "<td class=n data-v=\"%.17g\" title=\"%.0f bytes\">%s</td>",
             result->metric[FM_METRIC_BYTES_ALLOCATED], result->metric[FM_METRIC_BYTES_ALLOCATED],
             bytes);
}

static bool has_message(const fm_group *group)
{
    for (size_t i = 0; i < group->count; i++)
        if (group->cases[i]->message[0] != '\0')
            return true;
    return false;
}

/* One of the known words, and a mark with its reason where the times cannot be relied on. */
static void add_status(fm_text *page, const fm_case_row *result)
{
    text_add(page, "<td>%s", result->status);
    if (result->noisy[0] != '\0') {
        text_add(page, " <mark title=\"");
        html_add(page, result->noisy);
        text_add(page, "\">noisy</mark>");
    }
    text_add(page, "</td>");
}

static const char *standing_mark(fm_standing standing)
{
    return standing == FM_STANDING_FRONTIER ? "&#9679;"
           : standing == FM_STANDING_TIED   ? "&#9675;"
                                            : "";
}

static void add_row(fm_text *page, const fm_case_row *result, fm_standing standing,
                    bool has_messages)
{
    char title[96];
    group_series_title(title, result, NULL);
    text_add(page, "<tr class=\"%s\"><td data-v=\"%d\">%s</td><td class=name>",
             result->is_ok         ? "ok"
             : result->is_measured ? "wrong"
                                   : "none",
             FM_STANDING_FRONTIER - (int)standing, standing_mark(standing));
    html_add(page, title);
    text_add(page, "</td>");
    html_add_number(page, 8, result->k);
    html_add_number(page, 8, result->metric[FM_METRIC_N]);
    add_status(page, result);
    add_interval(page, result, FM_METRIC_FRAME_MS, 4);
    add_interval(page, result, FM_METRIC_TIMES_FLOOR, 3);
    add_memory(page, result);
    html_add_number(page, 12, result->metric[FM_METRIC_MISSING]);
    html_add_number(page, 12, result->metric[FM_METRIC_EXTRA]);
    html_add_number(page, 12, result->metric[FM_METRIC_MISORDERED]);
    html_add_number(page, 3, result->metric[FM_METRIC_RMSE]);
    html_add_number(page, 3, result->metric[FM_METRIC_TOTAL_RMSE]);
    html_add_number(page, 3, result->metric[FM_METRIC_TRUNCATION_RMSE]);
    if (has_messages) {
        text_add(page, "<td class=message>");
        html_add(page, result->message);
        text_add(page, "</td>");
    }
    text_add(page, "</tr>\n");
}

static void add_head(fm_text *page, size_t column)
{
    const fm_metric_info *metric = &fm_metrics[columns[column].metric];
    const bool is_metric = columns[column].title == NULL;
    text_add(page, "<th title=\"");
    html_add(page, is_metric ? metric->definition : columns[column].help);
    text_add(page, "\">%s</th>", is_metric ? metric->name : columns[column].title);
}

void case_table_add(fm_text *page, const fm_group *group, const fm_error_kind *kind)
{
    fm_place *places = calloc(group->count + 1, sizeof *places);
    if (places == NULL) {
        page->failed = true;
        return;
    }
    page->failed |= !standings_make(places, group, kind);
    const bool has_messages = has_message(group);
    text_add(page, "<div class=table><table><thead><tr>");
    for (size_t i = 0; i < COLUMN_COUNT - (has_messages ? 0 : 1); i++)
        add_head(page, i);
    text_add(page, "</tr></thead><tbody>\n");
    for (size_t i = 0; i < group->count; i++)
        add_row(page, group->cases[i], places[i].standing, has_messages);
    text_add(page, "</tbody></table></div>\n");
    free(places);
}
