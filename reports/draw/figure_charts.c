#include "figure_charts.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/text.h"
#include "figure_job.h"
#include "read/options.h"
#include "read/workload.h"

static const double plot_width_px = 560, plot_height_px = 380;

fm_figure_cases figure_cases(const fm_result_files *results, const fm_paper_figure *figure)
{
    return (fm_figure_cases){ figure, results->figures != NULL,
                              result_files_figure(results, figure->id) };
}

bool figure_takes_case(const fm_case_row *result, const void *cases)
{
    const fm_figure_cases *of = cases;
    if (of->is_listed)
        return (result->figures & of->bit) != 0;
    return name_list_has(&of->figure->methods, result->method) &&
           name_list_has(&of->figure->scenes, result->scene) &&
           name_list_has(&of->figure->feeds, result->feed);
}

static void note(fm_figure_job *at, fm_numbers *numbers, double value)
{
    if (numbers->count == numbers->capacity) {
        const size_t capacity = numbers->capacity > 0 ? 2 * numbers->capacity : 64;
        double *items = reallocarray(numbers->items, capacity, sizeof *items);
        if (items == NULL) {
            at->chart->failed = true;
            return;
        }
        numbers->items = items;
        numbers->capacity = capacity;
    }
    numbers->items[numbers->count++] = value;
}

void figure_note_x(fm_figure_job *at, double value)
{
    note(at, &at->x, value);
}

void figure_note_y(fm_figure_job *at, double value)
{
    note(at, &at->y, value);
}

/* Where n = r k, the layers of a case without a k tell which k the others have; else NAN. */
static double k_of_workload(const fm_case_row *result)
{
    return result->n / result->r;
}

bool figure_is_level(const fm_figure_job *at, const fm_case_row *result)
{
    return strcmp(at->from->x, "k") == 0 && !group_uses_k(at->group, result) &&
           isnan(k_of_workload(result));
}

bool figure_is_by_scene(const fm_figure_job *at)
{
    return strcmp(at->from->x, "scene") == 0;
}

const char *figure_scene_name(const fm_figure_job *at, size_t place)
{
    const char *scene = at->figure->scenes.names[place - 1], *slash = strrchr(scene, '/');
    return slash != NULL ? slash + 1 : scene;
}

size_t figure_add_upright(fm_chart *chart, double x_px, const char *text)
{
    fm_label *label = chart_add_label(chart);
    if (label == NULL)
        return 0;
    *label = (fm_label){ .x_px = x_px + 4, .y_px = -7, .anchor = FM_ANCHOR_END, .upright = true };
    snprintf(label->text, sizeof label->text, "%.63s", text);
    return (size_t)chart_text_width_px(label->text, 11);
}

/* Scenes are numbered as the figure lists them; an option's value may be an x too. */
double figure_x(const fm_figure_job *at, const fm_case_row *result)
{
    char option[FM_OPTION_VALUE_BYTES];
    for (size_t i = 0; figure_is_by_scene(at) && i < at->figure->scenes.count; i++)
        if (strcmp(at->figure->scenes.names[i], result->scene) == 0)
            return (double)(i + 1);
    if (strcmp(at->from->x, "k") == 0 && isnan(result->k))
        return k_of_workload(result);
    double x = result_files_metric(at->results, result, at->from->x);
    options_value(option, result->options, at->from->x);
    if (isnan(x) && !text_to_double(&x, option))
        x = NAN;
    return x;
}

/* The distinct x of all measured cases that use x, rising; at least one when anything is measured.
 */
size_t figure_distinct_x(double *xs, const fm_figure_job *at)
{
    size_t count = 0;
    for (size_t pass = 0; pass < 2 && count == 0; pass++)
        for (size_t i = 0; i < at->group->count; i++) {
            const fm_case_row *result = at->group->cases[i];
            double x = figure_x(at, result);
            if (!result->is_measured || !isfinite(x) || (pass == 0 && figure_is_level(at, result)))
                continue;
            size_t place = count;
            while (place > 0 && xs[place - 1] >= x)
                place--;
            if (place < count && xs[place] == x)
                continue;
            memmove(xs + place + 1, xs + place, (count - place) * sizeof *xs);
            xs[place] = x;
            count++;
        }
    return count;
}

fm_name_list figure_free_columns(const fm_figure_chart *chart)
{
    fm_name_list list = chart->across;
    if (list.count < FM_NAME_LIST)
        list.names[list.count++] = chart->x;
    return list;
}

const fm_group *figure_reference_group(const fm_groups *reference, const fm_group *group,
                                       const fm_figure_chart *chart)
{
    static const char *const other[] = { "device", "width_px", "height_px", "k" };
    fm_name_list free_columns = figure_free_columns(chart);
    for (size_t i = 0; i < sizeof other / sizeof other[0]; i++)
        if (free_columns.count < FM_NAME_LIST)
            free_columns.names[free_columns.count++] = other[i];
    for (size_t i = 0; i < reference->count; i++)
        if (workload_same(reference->groups[i].cases[0], group->cases[0], &free_columns))
            return &reference->groups[i];
    return NULL;
}

/* How much of the group's title holds for all that is drawn: its end names the feed. */
static int title_bytes(const fm_group *group, const fm_figure_chart *from)
{
    const int most = 90;
    const char *feed = strrchr(group->title, ',');
    if (feed == NULL || feed - group->title > most || !name_list_names(&from->across, "feed"))
        return most;
    return (int)(feed - group->title);
}

fm_status figure_chart_make(fm_chart *chart, const fm_paper_figure *figure,
                            const fm_figure_chart *from, const fm_figure_source *own,
                            const fm_figure_source *reference, fm_error *err)
{
    fm_status status = FM_OK;
    const fm_group *group = own->group;
    *chart = (fm_chart){ .x.length_px = plot_width_px, .y.length_px = plot_height_px };
    fm_figure_job at = {
        .chart = chart, .figure = figure, .from = from, .results = own->results, .group = group
    };
    fm_figure_job other = { .chart = chart,
                            .figure = figure,
                            .from = from,
                            .results = reference->results,
                            .group = reference->group };
    double *xs = calloc(group->count + 1, sizeof *xs);
    if (xs == NULL) {
        status = fm_fail(err, FM_NO_MEMORY, "figure %s", figure->id);
        goto out;
    }
    snprintf(chart->title, sizeof chart->title, "%.40s: %.110s", figure->id, from->title);
    if (figure_is_by_scene(&at))
        snprintf(chart->subtitle, sizeof chart->subtitle, "%zu scenes, %.90s%s%.90s",
                 figure->scenes.count, group->cases[0]->device,
                 group->workload[0] != '\0' ? "; " : "", group->workload);
    else
        snprintf(chart->subtitle, sizeof chart->subtitle, "%.*s%s%.100s", title_bytes(group, from),
                 group->title, group->workload[0] != '\0' ? "; " : "", group->workload);
    if (from->kind == FM_FIGURE_LINES)
        status = figure_make_lines(&at, &other, xs, err);
    else if (from->kind == FM_FIGURE_TORNADO)
        status = figure_make_tornado(&at, err);
    else
        status = figure_make_bars(&at, xs, err);
out:
    free(xs);
    free(at.x.items);
    free(at.y.items);
    return status;
}
