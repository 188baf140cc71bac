#include "figure_labels.h"
#include "model/metrics.h"

#include <stdio.h>
#include <string.h>

void figure_style_series(fm_series *series, const fm_method_info *look)
{
    series->colour = look_family_colour(look->family);
    series->marker = look->marker;
    series->has_marker = true;
    series->stroke = look->is_dashed ? FM_STROKE_DASHED : FM_STROKE_SOLID;
}

const char *figure_scene_name(const fm_figure_job *job, size_t place)
{
    const char *scene = job->figure->scenes.items[place - 1], *slash = strrchr(scene, '/');
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

/* Titles of keys, where the name is not enough. Metrics have titles of their own. */
static const struct {
    const char *name, *title, *unit;
} keys[] = {
    { "k", "k (fragments kept per pixel)", "" },
    { "n", "n (layers)", "" },
    { "pixel_density", "pixel density", "" },
    { "tessellation", "tessellation (cells a side)", "" },
    { "width_px", "width of the viewport", "px" },
};

static void quantity_title(char title[128], const char *name)
{
    const fm_metric_info *metric = metric_describe(name);
    const char *unit = metric != NULL ? metric->unit : "";
    fm_metric own;
    if (metric_find(&own, name)) /* families keep the name, which says whose they are */
        name = metric->title;
    for (size_t i = 0; i < sizeof keys / sizeof keys[0]; i++)
        if (strcmp(keys[i].name, name) == 0) {
            name = keys[i].title;
            unit = keys[i].unit;
            break;
        }
    snprintf(title, 128, "%.80s%s%s%s", name, unit[0] == '\0' ? "" : " [", unit,
             unit[0] == '\0' ? "" : "]");
}

void figure_title_column(char title[128], const char *column)
{
    quantity_title(title, column);
}

void figure_title_quantity(char title[128], const fm_text_list *metrics)
{
    quantity_title(title, metrics->items[0]);
}

void figure_title_ratio(char title[128], const fm_figure_job *job)
{
    char own[128];
    const fm_method_info look = figure_look(job, job->from->ratio_to);
    quantity_title(own, job->from->y);
    snprintf(title, 128, "%.*s / that of %.50s", (int)strcspn(own, "["), own,
             look.title != NULL ? look.title : job->from->ratio_to);
}
