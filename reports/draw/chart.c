#include "chart.h"

#include <stdlib.h>

/* Room for one more entry, zeroed; NULL when there is no memory. */
static void *chart_grow(void **entries, size_t *count, size_t *capacity, size_t entry_bytes)
{
    if (*count == *capacity) {
        size_t more = *capacity == 0 ? 16 : *capacity * 2;
        void *grown = reallocarray(*entries, more, entry_bytes);
        if (grown == NULL)
            return NULL;
        *entries = grown;
        *capacity = more;
    }
    return (char *)*entries + entry_bytes * (*count)++;
}

fm_series *chart_add_series(fm_chart *chart)
{
    void *entries = chart->series;
    fm_series *series =
        chart_grow(&entries, &chart->series_count, &chart->series_capacity, sizeof *series);
    chart->series = entries;
    chart->failed |= series == NULL;
    if (series != NULL)
        *series = (fm_series){ 0 };
    return series;
}

void chart_add_point(fm_chart *chart, fm_series *series, const fm_point *point)
{
    void *entries = series->points;
    fm_point *added =
        chart_grow(&entries, &series->point_count, &series->point_capacity, sizeof *added);
    series->points = entries;
    chart->failed |= added == NULL;
    if (added != NULL)
        *added = *point;
}

fm_bar *chart_add_bar(fm_chart *chart)
{
    void *entries = chart->bars;
    fm_bar *bar = chart_grow(&entries, &chart->bar_count, &chart->bar_capacity, sizeof *bar);
    chart->bars = entries;
    chart->failed |= bar == NULL;
    if (bar != NULL)
        *bar = (fm_bar){ 0 };
    return bar;
}

fm_label *chart_add_label(fm_chart *chart)
{
    void *entries = chart->labels;
    fm_label *label =
        chart_grow(&entries, &chart->label_count, &chart->label_capacity, sizeof *label);
    chart->labels = entries;
    chart->failed |= label == NULL;
    if (label != NULL)
        *label = (fm_label){ 0 };
    return label;
}

void chart_free(fm_chart *chart)
{
    for (size_t i = 0; i < chart->series_count; i++)
        free(chart->series[i].points);
    free(chart->series);
    free(chart->bars);
    free(chart->labels);
    *chart = (fm_chart){ 0 };
}
