#include "case_table.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "draw/speed_error.h"
#include "html.h"

static const struct {
    const char *title, *help;
} columns[] = {
    { "&#9679;", "on the Pareto frontier" },
    { "method", "as its paper names it" },
    { "k", "fragments kept per pixel" },
    { "n", "most fragments of any pixel" },
    { "status", "ok, or why there is no time" },
    { "frame_ms", "median of all samples: of the GPU passes together" },
    { "interval", "95 % bootstrap interval of frame_ms" },
    { "&times; floor", "store time over the floor's; of frames with timers=frame" },
    { "memory", "bytes_allocated" },
    { "missing", "wanted fragments that were not captured" },
    { "extra", "captured fragments that the pixel does not have" },
    { "misordered", "neighbours in the wrong order" },
    { "rmse", "against the truth of what the method promises to keep" },
    { "total_rmse", "against the picture of all fragments" },
    { "truncation_rmse", "what keeping only k costs, whatever the method" },
    { "message", "" }, /* last: left out where none has one */
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

static void add_time(fm_text *page, const fm_case_row *result)
{
    html_add_number(page, 4, result->is_measured ? result->frame_ms : NAN);
    if (result->is_measured && isfinite(result->frame_ms_low) && isfinite(result->frame_ms_high))
        text_add(page, "<td class=n>[%.4g, %.4g]</td>", result->frame_ms_low,
                 result->frame_ms_high);
    else
        text_add(page, "<td></td>");
    html_add_number(page, 3, result->times_floor);
}

static void add_memory(fm_text *page, const fm_case_row *result)
{
    char bytes[24];
    if (isnan(result->bytes_allocated)) {
        text_add(page, "<td></td>");
        return;
    }
    format_bytes(bytes, result->bytes_allocated);
    text_add(page, "<td class=n data-v=\"%.17g\" title=\"%.0f bytes\">%s</td>",
             result->bytes_allocated, result->bytes_allocated, bytes);
}

static bool has_message(const fm_group *group)
{
    for (size_t i = 0; i < group->count; i++)
        if (group->cases[i]->message[0] != '\0')
            return true;
    return false;
}

static void add_row(fm_text *page, const fm_group *group, size_t index, bool on_frontier)
{
    const fm_case_row *result = group->cases[index];
    char title[96];
    group_series_title(title, result, NULL);
    text_add(page, "<tr class=\"%s\"><td data-v=\"%d\">%s</td><td class=name>",
             result->is_ok         ? "ok"
             : result->is_measured ? "wrong"
                                   : "none",
             on_frontier ? 0 : 1, on_frontier ? "&#9679;" : "");
    html_add(page, title);
    text_add(page, "</td>");
    html_add_number(page, 8, result->k);
    html_add_number(page, 8, result->n);
    text_add(page, "<td>%s</td>", result->status); /* one of the known words */
    add_time(page, result);
    add_memory(page, result);
    html_add_number(page, 12, result->missing);
    html_add_number(page, 12, result->extra);
    html_add_number(page, 12, result->misordered);
    html_add_number(page, 3, result->rmse);
    html_add_number(page, 3, result->total_rmse);
    html_add_number(page, 3, result->truncation_rmse);
    if (has_message(group)) {
        text_add(page, "<td class=message>");
        html_add(page, result->message);
        text_add(page, "</td>");
    }
    text_add(page, "</tr>\n");
}

void case_table_add(fm_text *page, const fm_group *group)
{
    bool *on = calloc(group->count + 1, sizeof *on);
    if (on == NULL) {
        page->failed = true;
        return;
    }
    speed_error_frontier(on, group);
    text_add(page, "<div class=table><table><thead><tr>");
    for (size_t i = 0; i < COLUMN_COUNT - (has_message(group) ? 0 : 1); i++)
        text_add(page, "<th title=\"%s\">%s</th>", columns[i].help, columns[i].title);
    text_add(page, "</tr></thead><tbody>\n");
    for (size_t i = 0; i < group->count; i++)
        add_row(page, group, i, on[i]);
    text_add(page, "</tbody></table></div>\n");
    free(on);
}
