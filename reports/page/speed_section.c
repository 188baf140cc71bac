#include "speed_section.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "case_table.h"
#include "cheapest_table.h"
#include "draw/speed_error.h"
#include "html.h"
#include "roofline/roofline.h"

/* A reader compares a few charts; all workloads have a table. */
enum { CHARTS_MOST = 24, ROWS_MOST = 40 };

static fm_status add_group(fm_writer *to, const fm_group *group, bool has_chart)
{
    fm_chart chart;
    char name[160];
    fm_status status = FM_OK;
    text_add(&to->page, "<p class=faint>");
    html_add(&to->page, group->workload);
    text_add(&to->page, "</p>\n");
    snprintf(name, sizeof name, "speed-error-%s", group->name);
    if (has_chart) {
        status = speed_error_chart(&chart, group, to->desc->error, to->err);
        status = writer_add_chart(to, &chart, status, name);
    }
    if (status == FM_OK)
        case_table_add(&to->page, group, to->desc->error);
    if (status == FM_OK)
        cheapest_table_add(&to->page, group, to->desc->error);
    return status;
}

/* One chart for each device and feed over all of its workloads. */
static fm_status add_overall(fm_writer *to, const fm_groups *groups)
{
    fm_overalls overalls;
    fm_status status = overalls_make(&overalls, groups, to->desc->error, to->err);
    for (size_t i = 0; i < overalls.count && status == FM_OK; i++) {
        fm_chart chart;
        char name[64];
        snprintf(name, sizeof name, "speed-error-all-%zu", i + 1);
        status = speed_error_overall_chart(&chart, &overalls.items[i], to->desc->error, to->err);
        status = writer_add_chart(to, &chart, status, name);
    }
    overalls_free(&overalls);
    return status;
}

/* Below a paper's figures its many workloads are folded away. */
fm_status speed_section_add(fm_writer *to, const fm_groups *groups, bool is_folded)
{
    fm_status status = FM_OK;
    text_add(&to->page, "<h2 id=speed>Speed against error</h2>\n");
    if (groups->count > CHARTS_MOST)
        text_add(
            &to->page,
            "<p class=note>The first %d of %zu workloads have a chart; all have a table.</p>\n",
            CHARTS_MOST, groups->count);
    for (size_t i = 0; i < groups->count && status == FM_OK; i++) {
        text_add(&to->page, is_folded ? "<details><summary>" : "<h3>");
        html_add(&to->page, groups->groups[i].title);
        if (is_folded) {
            text_add(&to->page, "; ");
            html_add(&to->page, groups->groups[i].workload);
        }
        text_add(&to->page, is_folded ? "</summary>\n" : "</h3>\n");
        status = add_group(to, &groups->groups[i], i < CHARTS_MOST);
        text_add(&to->page, is_folded ? "</details>\n" : "");
    }
    if (status == FM_OK)
        status = add_overall(to, groups);
    if (groups->count == 0)
        text_add(&to->page, "<p class=note>summary.csv has no case yet.</p>\n");
    return status;
}

static void add_bound_row(fm_text *page, const fm_case_row *result)
{
    char title[96];
    group_series_title(title, result, NULL);
    text_add(page, "<tr><td class=name>");
    html_add(page, title);
    text_add(page, "</td>");
    html_add_number(page, 8, result->k);
    text_add(page, "<td>");
    html_add(page, result->scene);
    text_add(page, "</td><td>%s</td>", result->feed);
    html_add_number(page, 4, result->metric[FM_METRIC_FRAME_MS]);
    html_add_number(page, 4, result->metric[FM_METRIC_BOUND_MS]);
    html_add_number(page, 3, result->metric[FM_METRIC_TIMES_BOUND]);
    if (isfinite(result->low[FM_METRIC_TIMES_BOUND]))
        text_add(page, "<td class=n>[%.3g, %.3g]</td>", result->low[FM_METRIC_TIMES_BOUND],
                 result->high[FM_METRIC_TIMES_BOUND]);
    else
        text_add(page, "<td></td>");
    text_add(page, "<td>");
    html_add(page, result->limited_by);
    text_add(page, "</td>");
    html_add_number(page, 3, roofline_bytes(result));
    html_add_number(page, 8, result->metric[FM_METRIC_ATOMICS]);
    text_add(page, "</tr>\n");
}

/* The cases that are nearest to what the device allows. */
static fm_status add_bounds(fm_writer *to, const fm_roofline *of)
{
    const fm_case_row **sorted = roofline_sorted(of);
    if (sorted == NULL)
        return fm_fail(to->err, FM_NO_MEMORY, "%zu cases", of->count);
    if (of->count > ROWS_MOST)
        text_add(&to->page, "<p class=note>The first %d of %zu cases; summary.csv has all.</p>\n",
                 ROWS_MOST, of->count);
    text_add(&to->page,
             "<div class=table><table><thead><tr><th>method</th><th>k</th><th>scene</th>"
             "<th>feed</th><th>frame_ms</th><th>bound_ms</th><th>&times; bound</th><th>interval"
             "</th><th>limited by</th><th>bytes / fragment</th><th>atomics</th></tr></thead>"
             "<tbody>\n");
    for (size_t i = 0; i < of->count && i < ROWS_MOST; i++)
        add_bound_row(&to->page, sorted[i]);
    text_add(&to->page, "</tbody></table></div>\n");
    free(sorted);
    return FM_OK;
}

fm_status hardware_section_add(fm_writer *to)
{
    fm_rooflines devices;
    fm_status status = rooflines_make(&devices, to->results, to->err);
    text_add(&to->page, "<h2 id=hardware>What the device allows</h2>\n");
    if (status == FM_OK && devices.count == 0)
        text_add(&to->page, "<p class=note>No device of this run was calibrated: <code>fragmark "
                            "calibrate device</code> does it, and the next run has its limits."
                            "</p>\n");
    for (size_t i = 0; i < devices.count && status == FM_OK; i++) {
        fm_chart chart;
        char name[64];
        snprintf(name, sizeof name, "roofline-%zu", i + 1);
        text_add(&to->page, "<h3>");
        html_add(&to->page, devices.items[i].device_name);
        text_add(&to->page, "</h3>\n");
        status = roofline_chart(&chart, &devices.items[i], to->err);
        status = writer_add_chart(to, &chart, status, name);
        if (status == FM_OK)
            status = add_bounds(to, &devices.items[i]);
    }
    rooflines_free(&devices);
    return status;
}
