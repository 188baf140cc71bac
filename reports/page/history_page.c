#include "history_page.h"

#include <math.h>
#include <string.h>

#include "html.h"
#include "page.h"

enum { SPARK_WIDTH = 260, SPARK_HEIGHT = 40, SPARK_EDGE = 5, RUNS = 100, DIGITS = 4 };

/* A sparkline's scale. */
typedef struct spark {
    size_t count;
    double low, high; /* logarithms of ratios */
} spark;

static double log_ratio(const fm_series *series, size_t index)
{
    return log(series->nights[index].centre.ratio);
}

/* Noise of a percent fills no sparkline: 6 % is the least that its height stands for. */
static spark scale_of(const fm_series *series)
{
    static const double least = 0.06;
    spark scale = { series->count, INFINITY, -INFINITY };
    for (size_t i = 0; i < series->count; i++) {
        const double value = log_ratio(series, i);
        scale.low = fmin(scale.low, value); /* fmin and fmax pass over NAN */
        scale.high = fmax(scale.high, value);
    }
    const double missing = fmax(0.0, least - (scale.high - scale.low));
    scale.low -= missing / 2;
    scale.high += missing / 2;
    return scale;
}

static double place_x(const spark *scale, double index)
{
    return SPARK_EDGE + (SPARK_WIDTH - 2 * SPARK_EDGE) * index /
                            (scale->count > 1 ? (double)(scale->count - 1) : 1.0);
}

static double place_y(const spark *scale, double value)
{
    return SPARK_HEIGHT - SPARK_EDGE -
           (SPARK_HEIGHT - 2 * SPARK_EDGE) * (value - scale->low) / (scale->high - scale->low);
}

static const char *colour_of(double shift)
{
    return shift > 0 ? "#b3261e" : "#00644b";
}

static void add_steps(fm_text *page, const fm_series *series, const spark *scale)
{
    for (size_t i = 0; i < series->step_count; i++) {
        const fm_step *step = &series->steps[i];
        text_add(
            page,
            "<line x1=\"%.1f\" x2=\"%.1f\" y1=\"0\" y2=\"%d\" stroke=\"%s\" stroke-width=\"2\">"
            "<title>",
            place_x(scale, (double)step->index - 0.5), place_x(scale, (double)step->index - 0.5),
            SPARK_HEIGHT, colour_of(step->shift));
        html_add(page, series->nights[step->index].started);
        text_add(page, ": %+.1f %%</title></line>", 100.0 * (exp(step->shift) - 1.0));
    }
}

static void add_curve(fm_text *page, const fm_series *series, const spark *scale)
{
    bool is_drawn = false;
    text_add(page, "<path fill=\"none\" stroke=\"#555\" d=\"");
    for (size_t i = 0; i < series->count; i++) {
        const double value = log_ratio(series, i);
        if (isnan(value))
            continue;
        text_add(page, "%s%.1f %.1f", is_drawn ? "L" : "M", place_x(scale, (double)i),
                 place_y(scale, value));
        is_drawn = true;
    }
    text_add(page, "\"/>");
}

/* Of each night, with what it was; the last one stands out. */
static void add_points(fm_text *page, const fm_series *series, const spark *scale)
{
    for (size_t i = 0; i < series->count; i++) {
        const fm_series_night *night = &series->nights[i];
        const bool is_measured = !isnan(night->centre.ratio);
        text_add(page, "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"%s\" fill=\"%s\"><title>",
                 place_x(scale, (double)i),
                 is_measured ? place_y(scale, log_ratio(series, i)) : SPARK_HEIGHT - 2.0,
                 i + 1 == series->count ? "3" : "1.6", is_measured ? "#222" : "#b3261e");
        html_add(page, night->started);
        text_add(page, " ");
        html_add(page, night->git_commit);
        if (is_measured)
            text_add(page, " %.4g", night->centre.ratio);
        text_add(page, " ");
        html_add(page, night->status);
        text_add(page, "</title></circle>");
    }
}

static void add_sparkline(fm_text *page, const fm_series *series)
{
    const spark scale = scale_of(series);
    text_add(page,
             "<td><svg class=spark role=img aria-label=\"%zu nights\" width=\"%d\" height=\"%d\" "
             "viewBox=\"0 0 %d %d\">",
             series->count, SPARK_WIDTH, SPARK_HEIGHT, SPARK_WIDTH, SPARK_HEIGHT);
    add_steps(page, series, &scale);
    if (isfinite(scale.low))
        add_curve(page, series, &scale);
    add_points(page, series, &scale);
    text_add(page, "</svg></td>");
}

static void add_text_cell(fm_text *page, const char *text)
{
    text_add(page, "<td>");
    html_add(page, text);
    text_add(page, "</td>");
}

static void add_step_cells(fm_text *page, const fm_series *series)
{
    const fm_step *step = series_last_step(series);
    if (step == NULL) {
        text_add(page, "<td></td><td></td><td></td>");
        return;
    }
    const fm_series_night *night = &series->nights[step->index];
    add_text_cell(page, night->started);
    text_add(page, "<td class=n data-v=\"%.6g\"><span class=\"verdict v%d\">%+.1f %%</span></td>",
             step->shift, step->shift > 0 ? 2 : 0, 100.0 * (exp(step->shift) - 1.0));
    text_add(page, "<td><code>");
    html_add(page, night->git_commit);
    text_add(page, "</code></td>");
}

static void add_row(fm_text *page, const fm_series *series)
{
    const fm_series_night *last = &series->nights[series->count - 1];
    fm_text alarm = { 0 };
    alarm_add_words(&alarm, &series->alarm);
    text_add(page, "<tr%s>", series->alarm.verdict == FM_ALARM_STEP ? " class=wrong" : "");
    add_text_cell(page, series->title);
    add_sparkline(page, series);
    html_add_number(page, DIGITS, last->centre.ratio);
    html_add_number(page, 2, 100.0 * last->centre.standard_error);
    add_step_cells(page, series);
    add_text_cell(page, last->status);
    add_text_cell(page, alarm.bytes != NULL ? alarm.bytes : "");
    add_text_cell(page, series->machine);
    add_text_cell(page, series->device_name);
    text_add(page, "</tr>\n");
    page->failed |= alarm.failed;
    text_free(&alarm);
}

static void add_series(fm_text *page, const fm_series_list *list, const char *reference)
{
    text_add(page, "<h2>Cases</h2>\n<p>A point is a night: the ratio of <code>frame_ms</code> to "
                   "that of <b>");
    html_add(page, reference != NULL ? reference : "the floor");
    text_add(page,
             "</b> in the same run, the middle of its launches. Up is slower; a sparkline is at "
             "least 6 %% high. A bar stands where the ratios before and behind it differ (red: "
             "slower from there on). A red point below was not measured. The newest steps come "
             "first, of one night the worst. Machines are never mixed.</p>\n"
             "<div class=table><table><thead><tr><th>case</th><th>nights</th><th>last ratio</th>"
             "<th>+- %%</th><th>last step</th><th>by</th><th>commit</th><th>status</th>"
             "<th>alarm</th><th>machine</th><th>device</th></tr></thead><tbody>\n");
    for (size_t i = 0; i < list->count; i++)
        add_row(page, &list->items[i]);
    text_add(page, "</tbody></table></div>\n");
}

static void add_machines(fm_text *page, const fm_run_list *runs)
{
    text_add(page, "<h2>Machines</h2>\n<dl>\n");
    for (size_t i = 0; i < runs->count; i++) {
        const fm_run_entry *run = &runs->items[i];
        bool is_told = false;
        for (size_t j = 0; j < i && !is_told; j++)
            is_told = strcmp(runs->items[j].machine, run->machine) == 0;
        if (is_told)
            continue;
        text_add(page, "<dt>");
        html_add(page, run->machine);
        text_add(page, "</dt><dd>");
        html_add(page, run->cpu);
        text_add(page, ", ");
        html_add(page, run->cores);
        text_add(page, " cores, %.1f GiB</dd>\n", run->memory_bytes / (1 << 30));
    }
    text_add(page, "</dl>\n");
}

static void add_runs(fm_text *page, const fm_run_list *runs)
{
    text_add(page, "<h2>Runs</h2>\n");
    if (runs->count > RUNS)
        text_add(page, "<p>The last %d of %zu.</p>\n", RUNS, runs->count);
    text_add(page, "<div class=table><table><thead><tr><th>started</th><th>commit</th>"
                   "<th>machine</th><th>cases</th><th>ok</th><th>failed</th><th>folder</th></tr>"
                   "</thead><tbody>\n");
    for (size_t i = 0; i < runs->count && i < RUNS; i++) {
        const fm_run_entry *run = &runs->items[i];
        text_add(page, "<tr>");
        add_text_cell(page, run->started);
        add_text_cell(page, run->git_commit);
        add_text_cell(page, run->machine);
        html_add_number(page, 9, (double)run->cases);
        html_add_number(page, 9, (double)run->ok);
        html_add_number(page, 9, (double)run->failed);
        add_text_cell(page, run->directory);
        text_add(page, "</tr>\n");
    }
    text_add(page, "</tbody></table></div>\n");
}

fm_status history_page_write(const char *path, const fm_history_page_desc *desc, fm_error *err)
{
    fm_text page = { 0 };
    page_open(&page, "fragmark history", 0);
    text_add(&page, "<h1>fragmark history</h1>\n<p>%zu runs, %zu series.</p>\n", desc->runs->count,
             desc->series->count);
    add_series(&page, desc->series, desc->reference);
    add_runs(&page, desc->runs);
    add_machines(&page, desc->runs);
    page_end(&page);
    const fm_status status = page.failed
                                 ? fm_fail(err, FM_NO_MEMORY, "%s: no memory for the page", path)
                                 : text_write_file(path, page.bytes, page.length, err);
    text_free(&page);
    return status;
}
