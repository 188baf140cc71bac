#include "paper_figure.h"

#include <stdlib.h>
#include <string.h>

#include "base/text.h"
#include "model/metrics.h"

static const char *const chart_keys[] = { "id",      "kind",   "title",    "x",
                                          "y",       "parts",  "ratio_to", "with_paper",
                                          "y_scale", "across", "sweep" };
static const char *const swept_keys[] = { "name", "low", "high" };
static const char *const points_keys[] = { "metric", "parts", "series" };
static const char *const series_keys[] = { "method", "title", "at", "points" };
#define KEYS(list) (list), sizeof(list) / sizeof((list)[0])

static fm_status read_sweep(fm_figure_chart *chart, const fm_yaml *list, const fm_yaml_place *at)
{
    fm_status status = FM_OK;
    if (list == NULL)
        return FM_OK;
    if (list->kind != FM_YAML_LIST || list->count > FM_FIGURE_SWEPT)
        return fm_fail(at->err, FM_INVALID, "%s:%u: sweep: a list of up to %d is expected",
                       at->path, list->line, FM_FIGURE_SWEPT);
    for (size_t i = 0; i < list->count && status == FM_OK; i++) {
        fm_figure_swept *swept = &chart->sweep[chart->swept_count++];
        status = field_check_keys(&list->items[i], "sweep", KEYS(swept_keys), at);
        if (status == FM_OK)
            status = field_text(&swept->name, &list->items[i], "name", true, at);
        if (status == FM_OK)
            status = field_text(&swept->low, &list->items[i], "low", true, at);
        if (status == FM_OK)
            status = field_text(&swept->high, &list->items[i], "high", true, at);
    }
    return status;
}

/* What each kind needs. */
static fm_status check_chart(const fm_figure_chart *chart, const fm_yaml *map,
                             const fm_yaml_place *at)
{
    const bool is_tornado = chart->kind == FM_FIGURE_TORNADO;
    if (chart->kind != FM_FIGURE_STACKED_BARS && chart->ys.count == 0)
        return fm_fail(at->err, FM_INVALID, "%s:%u: y is missing", at->path, map->line);
    if (chart->kind == FM_FIGURE_STACKED_BARS &&
        (chart->parts.count == 0 || chart->parts.count > FM_FIGURE_PARTS))
        return fm_fail(at->err, FM_INVALID, "%s:%u: stacked-bars need 1 to %d parts", at->path,
                       map->line, FM_FIGURE_PARTS);
    if (is_tornado && (chart->swept_count == 0 || chart->ratio_to == NULL))
        return fm_fail(at->err, FM_INVALID, "%s:%u: a tornado needs sweep and ratio_to", at->path,
                       map->line);
    if (!is_tornado && chart->swept_count > 0)
        return fm_fail(at->err, FM_INVALID, "%s:%u: sweep is for kind tornado", at->path,
                       map->line);
    return FM_OK;
}

static fm_status read_chart(fm_figure_chart *chart, const fm_yaml *map, const fm_yaml_place *at)
{
    static const char *const kinds[] = { "lines", "stacked-bars", "grouped-bars", "tornado" };
    static const char *const scales[] = { "linear", "log" };
    int kind = 0, scale = 0;
    fm_status status = field_check_keys(map, "charts", KEYS(chart_keys), at);
    if (status == FM_OK)
        status = field_text(&chart->id, map, "id", true, at);
    if (status == FM_OK)
        status = field_text(&chart->title, map, "title", true, at);
    if (status == FM_OK)
        status = field_text(&chart->x, map, "x", true, at);
    if (status == FM_OK)
        status = field_word(&kind, map, "kind", kinds, 4, at);
    if (status == FM_OK)
        status = field_list(&chart->ys, map, "y", at);
    chart->y = chart->ys.count > 0 ? chart->ys.items[0] : "";
    if (status == FM_OK)
        status = field_text(&chart->ratio_to, map, "ratio_to", false, at);
    if (status == FM_OK)
        status = field_bool(&chart->with_paper, map, "with_paper", at);
    if (status == FM_OK)
        status = field_word(&scale, map, "y_scale", scales, 2, at);
    if (status == FM_OK)
        status = field_list(&chart->parts, map, "parts", at);
    if (status == FM_OK)
        status = field_list(&chart->free_columns, map, "across", at);
    if (status == FM_OK && !text_list_add(&chart->free_columns, chart->x))
        status = fm_fail(at->err, FM_NO_MEMORY, "%s: chart %s", at->path, chart->id);
    if (status == FM_OK)
        status = read_sweep(chart, yaml_tree_find(map, "sweep"), at);
    if (status == FM_OK && chart->ratio_to[0] == '\0')
        chart->ratio_to = NULL;
    chart->kind = (fm_figure_kind)kind;
    chart->is_log = scale == 1;
    return status == FM_OK ? check_chart(chart, map, at) : status;
}

static fm_status read_charts(fm_paper_figure *figure, const fm_yaml *list, const fm_yaml_place *at)
{
    if (list == NULL || list->kind != FM_YAML_LIST || list->count == 0 ||
        list->count > FM_FIGURE_CHARTS)
        return fm_fail(at->err, FM_INVALID, "%s:%u: charts: a list of 1 to %d is expected",
                       at->path, list == NULL ? 1 : list->line, FM_FIGURE_CHARTS);
    for (size_t i = 0; i < list->count; i++) {
        fm_status status = read_chart(&figure->charts[figure->chart_count++], &list->items[i], at);
        if (status != FM_OK)
            return status;
    }
    return FM_OK;
}

static fm_status read_point(fm_paper_point *point, const fm_yaml *list, size_t parts,
                            const fm_yaml_place *at)
{
    if (list->kind != FM_YAML_LIST || list->count != parts + 1)
        return fm_fail(at->err, FM_INVALID, "%s:%u: a point is [x, %zu values]", at->path,
                       list->line, parts);
    point->value = 0.0;
    for (size_t i = 0; i <= parts; i++) {
        double value;
        if (list->items[i].kind != FM_YAML_SCALAR || !text_to_double(&value, list->items[i].text))
            return fm_fail(at->err, FM_INVALID, "%s:%u: a point's values are numbers", at->path,
                           list->line);
        if (i == 0)
            point->x = value;
        else
            point->value += value;
    }
    return FM_OK;
}

static fm_status read_paper_series(fm_paper_figure *figure, const fm_yaml *map, size_t parts,
                                   const fm_yaml_place *at)
{
    fm_paper_point point = { 0 };
    fm_status status = field_check_keys(map, "series", KEYS(series_keys), at);
    if (status == FM_OK)
        status = field_text(&point.method, map, "method", true, at);
    if (status == FM_OK)
        status = field_text(&point.title, map, "title", true, at);
    if (status != FM_OK)
        return status;
    point.at = yaml_tree_find(map, "at");
    if (point.at != NULL && point.at->kind != FM_YAML_MAP)
        return fm_fail(at->err, FM_INVALID, "%s:%u: at: columns and numbers are expected", at->path,
                       point.at->line);
    const fm_yaml *points = yaml_tree_find(map, "points");
    if (points == NULL || points->kind != FM_YAML_LIST)
        return fm_fail(at->err, FM_INVALID, "%s:%u: points: a list is expected", at->path,
                       map->line);
    for (size_t i = 0; i < points->count; i++) {
        if (figure->point_count == FM_FIGURE_POINTS)
            return fm_fail(at->err, FM_INVALID, "%s:%u: more than %d points", at->path,
                           points->items[i].line, FM_FIGURE_POINTS);
        status = read_point(&point, &points->items[i], parts, at);
        if (status != FM_OK)
            return status;
        figure->points[figure->point_count++] = point;
    }
    return FM_OK;
}

static fm_status read_paper_points(fm_paper_figure *figure, const fm_yaml *map,
                                   const fm_yaml_place *at)
{
    fm_text_list parts = { 0 };
    if (map == NULL)
        return FM_OK;
    fm_status status = field_check_keys(map, "paper_points", KEYS(points_keys), at);
    if (status == FM_OK)
        status = field_list(&parts, map, "parts", at);
    if (status == FM_OK)
        status = field_text(&figure->points_metric, map, "metric", false, at);
    if (status == FM_OK && figure->points_metric[0] == '\0')
        figure->points_metric = fm_metrics[FM_METRIC_FRAME_MS].name;
    const fm_yaml *series = yaml_tree_find(map, "series");
    if (status == FM_OK && (series == NULL || series->kind != FM_YAML_LIST))
        status =
            fm_fail(at->err, FM_INVALID, "%s:%u: series: a list is expected", at->path, map->line);
    for (size_t i = 0; status == FM_OK && series != NULL && i < series->count; i++)
        status = read_paper_series(figure, &series->items[i], parts.count, at);
    text_list_free(&parts);
    return status;
}

/* Of a `run` of several blocks figures.csv tells which cases are the figure's. */
static fm_status read_run(fm_paper_figure *figure, const fm_yaml *run, const fm_yaml_place *at)
{
    if (run == NULL || run->kind == FM_YAML_LIST)
        return FM_OK;
    fm_status status = field_list(&figure->methods, run, "methods", at);
    if (status == FM_OK)
        status = field_list(&figure->scenes, run, "scenes", at);
    if (status == FM_OK)
        status = field_list(&figure->feeds, run, "feeds", at);
    return status;
}

/* Without `scenes` a block has all, and no scene stands in for another. */
static fm_status add_own_scenes(fm_paper_figure *figure, const fm_yaml *blocks,
                                const fm_yaml_place *at)
{
    fm_text_list scenes = { 0 };
    fm_status status = FM_OK;
    if (blocks == NULL)
        return FM_OK;
    for (size_t i = 0; i < (blocks->kind == FM_YAML_LIST ? blocks->count : 1); i++) {
        if (status == FM_OK)
            status = field_list(&scenes, blocks->kind == FM_YAML_LIST ? &blocks->items[i] : blocks,
                                "scenes", at);
        if (status == FM_OK && !text_list_add_all(&figure->own_scenes, &scenes))
            status = fm_fail(at->err, FM_NO_MEMORY, "%s: scenes", at->path);
        text_list_free(&scenes);
    }
    return status;
}

static fm_status read_parts(fm_paper_figure *figure, const fm_yaml_place *at)
{
    const fm_figure_file *file = &figure->file;
    fm_status status = field_list(&figure->deviations, file->tree, "deviations", at);
    if (status == FM_OK)
        status = read_run(figure, file->run, at);
    if (status == FM_OK)
        status = add_own_scenes(figure, file->run, at);
    if (status == FM_OK)
        status = add_own_scenes(figure, file->large, at);
    if (status == FM_OK && file->charts != NULL)
        status = read_charts(figure, file->charts, at);
    if (status == FM_OK)
        status = read_paper_points(figure, file->paper_points, at);
    if (status == FM_OK)
        status = claims_read(&figure->claims, &figure->claim_count, file->claims, at);
    return status;
}

fm_status paper_figure_read(fm_paper_figure **figure, const char *path, fm_error *err)
{
    const fm_yaml_place at = { .path = path, .err = err };
    *figure = NULL;
    fm_paper_figure *made = calloc(1, sizeof *made);
    if (made == NULL)
        return fm_fail(err, FM_NO_MEMORY, "%s", path);
    fm_status status = figure_file_read(&made->file, path, err);
    if (status == FM_OK)
        status = read_parts(made, &at);
    if (status != FM_OK) {
        paper_figure_close(made);
        return status;
    }
    made->id = made->file.id;
    made->paper = made->file.paper;
    made->title = made->file.title;
    made->source = made->file.source;
    made->has_table = made->file.table != NULL;
    *figure = made;
    return FM_OK;
}

void paper_figure_close(fm_paper_figure *figure)
{
    if (figure == NULL)
        return;
    for (size_t i = 0; i < figure->chart_count; i++) {
        text_list_free(&figure->charts[i].ys);
        text_list_free(&figure->charts[i].parts);
        text_list_free(&figure->charts[i].free_columns);
    }
    text_list_free(&figure->methods);
    text_list_free(&figure->scenes);
    text_list_free(&figure->own_scenes);
    text_list_free(&figure->feeds);
    text_list_free(&figure->deviations);
    claims_free(figure->claims, figure->claim_count);
    figure_file_close(&figure->file);
    free(figure);
}
