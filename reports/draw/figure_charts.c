#include "figure_charts.h"

#include <stdio.h>
#include <string.h>

#include "figure_bars.h"
#include "figure_labels.h"
#include "figure_lines.h"
#include "figure_tornado.h"
#include "read/workload.h"

static const double plot_width_px = 560, plot_height_px = 380;

fm_status figure_reference_group(const fm_group **found, const fm_groups *reference,
                                 const fm_group *group, const fm_figure_chart *chart, fm_error *err)
{
    static const char *const other[] = { "device", "width_px", "height_px", "k" };
    fm_text_list free_columns = { 0 };
    bool is_whole = text_list_add_all(&free_columns, &chart->free_columns);
    *found = NULL;
    for (size_t i = 0; i < sizeof other / sizeof other[0] && is_whole; i++)
        is_whole = text_list_add(&free_columns, other[i]);
    for (size_t i = 0; i < reference->count && is_whole && *found == NULL; i++)
        if (workload_same(reference->groups[i].cases[0], group->cases[0], &free_columns))
            *found = &reference->groups[i];
    text_list_free(&free_columns);
    return is_whole ? FM_OK : fm_fail(err, FM_NO_MEMORY, "chart %s", chart->id);
}

/* How much of the group's title holds for all that is drawn: its end names the feed. */
static int title_bytes(const fm_group *group, const fm_figure_chart *from)
{
    const int most = 90;
    const char *feed = strrchr(group->title, ',');
    if (feed == NULL || feed - group->title > most || !text_list_has(&from->free_columns, "feed"))
        return most;
    return (int)(feed - group->title);
}

static void name_chart(const fm_figure_job *job)
{
    fm_chart *chart = job->chart;
    const fm_group *group = job->group;
    const char *between = group->workload[0] != '\0' ? "; " : "";
    snprintf(chart->title, sizeof chart->title, "%.40s: %.110s", job->figure->id, job->from->title);
    if (figure_is_by_scene(job))
        snprintf(chart->subtitle, sizeof chart->subtitle, "%zu scenes, %.90s%s%.90s",
                 job->figure->scenes.count, group->cases[0]->device, between, group->workload);
    else
        snprintf(chart->subtitle, sizeof chart->subtitle, "%.*s%s%.100s",
                 title_bytes(group, job->from), group->title, between, group->workload);
}

static fm_status draw(fm_figure_job *job, const fm_figure_job *reference, fm_error *err)
{
    switch (job->from->kind) {
    case FM_FIGURE_LINES:
        return figure_make_lines(job, reference, err);
    case FM_FIGURE_STACKED_BARS:
    case FM_FIGURE_GROUPED_BARS:
        return figure_make_bars(job, err);
    case FM_FIGURE_TORNADO:
        return figure_make_tornado(job, err);
    }
    return FM_OK;
}

fm_status figure_chart_make(fm_chart *chart, const fm_paper_figure *figure,
                            const fm_figure_chart *from, const fm_figure_source *own,
                            const fm_figure_source *reference, fm_error *err)
{
    *chart = (fm_chart){ .x.length_px = plot_width_px, .y.length_px = plot_height_px };
    fm_figure_job job = {
        .chart = chart, .figure = figure, .from = from, .results = own->results, .group = own->group
    };
    fm_figure_job other = job;
    other.results = reference->results;
    other.group = reference->group;
    name_chart(&job);
    const fm_status status = draw(&job, &other, err);
    figure_job_free(&job);
    return status;
}
