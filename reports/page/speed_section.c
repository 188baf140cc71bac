#include "speed_section.h"

#include <stdio.h>

#include "case_table.h"
#include "cheapest_table.h"
#include "draw/speed_error.h"
#include "html.h"

/* A reader compares a few charts; all workloads have a table. */
enum { CHARTS_MOST = 24 };

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
