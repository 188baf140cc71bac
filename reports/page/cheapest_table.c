#include "cheapest_table.h"

#include <math.h>
#include <stdio.h>

#include "html.h"

static void add_ratio(fm_text *page, const fm_span *ratio)
{
    html_add_number(page, 3, ratio->value);
    if (ratio->low > 0 && isfinite(ratio->high))
        text_add(page, "<td class=n>[%.3g, %.3g]</td>", ratio->low, ratio->high);
    else
        text_add(page, "<td></td>");
}

static void add_row(fm_text *page, const fm_cheapest *one, double bound)
{
    char title[96];
    if (bound > 0)
        text_add(page, "<tr><td class=n data-v=\"%g\">%g</td>", bound, bound);
    else
        text_add(page, "<tr><td class=n data-v=\"0\">exact</td>");
    if (one->row == NULL) {
        text_add(page, "<td class=name>none</td><td></td><td></td><td></td><td></td><td></td>"
                       "</tr>\n");
        return;
    }
    group_series_title(title, one->row, NULL);
    text_add(page, "<td class=name>");
    html_add(page, title);
    text_add(page, "</td>");
    html_add_number(page, 8, one->row->k);
    html_add_number(page, 4, one->row->metric[FM_METRIC_FRAME_MS]);
    add_ratio(page, &one->ratio);
    html_add_number(page, 8, (double)one->tied_count);
    text_add(page, "</tr>\n");
}

void cheapest_table_add(fm_text *page, const fm_group *group, const fm_error_kind *kind)
{
    fm_cheapest cheapest[CHEAPEST_BOUNDS];
    if (!cheapest_make(cheapest, group, kind)) {
        page->failed = true;
        return;
    }
    if (cheapest[CHEAPEST_BOUNDS - 1].row == NULL)
        return;
    text_add(page,
             "<div class=table><table><thead><tr><th>%s up to</th><th>cheapest</th><th>k</th>"
             "<th title=\"median, in milliseconds\">frame_ms</th>"
             "<th title=\"its time over that of the cheapest exact case\">&times; exact</th>"
             "<th title=\"holds the true ratio if the intervals of both times hold these\">"
             "interval</th>"
             "<th title=\"others within the error whose times overlap with its own\">tied</th>"
             "</tr></thead><tbody>\n",
             fm_metrics[kind->metric].better == FM_BETTER_MORE ? "1 - similarity" : "error");
    for (int i = 0; i < CHEAPEST_BOUNDS; i++)
        add_row(page, &cheapest[i], cheapest_bounds[i]);
    text_add(page, "</tbody></table></div>\n");
}
