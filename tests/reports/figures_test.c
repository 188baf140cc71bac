/* Figures drawn from fabricated results: whose cases, which metrics, which marks. */
#include <sys/wait.h>

#include "draw/speed_error.h"
#include "figure_kit.h"
#include "read/case_metrics.h"

static const char figure_text[] =
    "id: f-1\npaper: f\ntitle: t\nrun:\n  - { methods: [a] }\n  - { methods: [b] }\n"
    "charts:\n"
    "  - { id: bars, kind: grouped-bars, title: c, x: k, y: fps, y_scale: log, with_paper: true }\n"
    "  - { id: lines, title: c, x: pixel_density, y: [frame_ms, resolve_ms] }\n"
    "paper_points:\n  metric: fps\n  parts: [fps]\n  series:\n"
    "    - { method: a, title: A, at: { pixel_density: 0.25 }, points: [[4, 50], [8, 40]] }\n"
    "    - { method: a, title: A, at: { pixel_density: 0.75 }, points: [[4, 7]] }\n";

static const fakes usual = { { { ROW("a", 4, 0.25, 10) },
                               { ROW("a", 8, 0.25, 20) },
                               { ROW("b", 4, 0.25, 40) },
                               { ROW("a", 4, 0.75, 30) } } };

static void open_fixture(fixture *made, const char *figures_csv)
{
    fixture_open(made, &usual, figure_text, figures_csv);
}

static size_t count_taken(const fixture *in)
{
    const fm_figure_cases cases = figure_cases(in->results, in->figure);
    size_t count = 0;
    for (size_t i = 0; i < in->results->count; i++)
        count += figure_takes_case(&in->results->cases[i], &cases);
    return count;
}

static void figures_csv_tells_whose_a_case_is(void **state)
{
    (void)state;
    fixture with;
    open_fixture(&with, "figure,case_id\nf-1,c0\nf-2,c0\nf-2,c1\nf-1,c3\nf-1,unknown\n");
    const fm_figure_cases cases = figure_cases(with.results, with.figure);
    assert_true(figure_takes_case(&with.results->cases[0], &cases));
    assert_false(figure_takes_case(&with.results->cases[1], &cases));
    assert_int_equal(count_taken(&with), 2);
    fixture_close(&with);
}

static void figure_that_figures_csv_does_not_name_takes_nothing(void **state)
{
    (void)state;
    fixture with;
    open_fixture(&with, "figure,case_id\nf-2,c0\n");
    assert_int_equal(count_taken(&with), 0);
    fixture_close(&with);
}

static void without_figures_csv_a_figure_of_several_runs_takes_all(void **state)
{
    (void)state;
    fixture with;
    open_fixture(&with, NULL);
    assert_int_equal(count_taken(&with), 4);
    fixture_close(&with);
}

static void frames_per_second_follow_from_the_time(void **state)
{
    (void)state;
    static const char *const fps[] = { "fps" };
    static const char *const sum[] = { "frame_ms", "resolve_ms", "count_ms" };
    fixture with;
    open_fixture(&with, NULL);
    const fm_case_row *row = &with.results->cases[0];
    assert_true(case_metric(with.results, row, "fps") == 100.0);
    const fm_interval rate = case_interval(with.results, row, fps, 1);
    assert_true(rate.median == 100.0 && rate.low < 100.0 && rate.high > 100.0);
    const fm_interval total = case_interval(with.results, row, sum, 3);
    assert_true(fabs(total.median - 11.0) < 1e-9); /* no count pass: nothing is added */
    fixture_close(&with);
}

static void grouped_bars_bear_the_papers_marks_of_their_workload(void **state)
{
    (void)state;
    drawing made;
    drawing_open(&made, &usual, figure_text, NULL, 0);
    assert_int_equal(made.groups.count, 2); /* by pixel density */
    assert_int_equal(made.chart.bar_count, 3);
    assert_true(made.chart.bars[0].y0 == made.chart.y.low && made.chart.bars[0].y1 == 100.0);
    assert_int_equal(made.chart.series[0].point_count, 3); /* intervals */
    assert_string_equal(made.chart.series[1].label, "paper");
    assert_int_equal(made.chart.series[1].point_count, 2);
    assert_true(made.chart.series[1].points[0].y == 50.0 &&
                made.chart.series[1].points[1].y == 40.0);
    drawing_close(&made);
}

static void charts_may_run_along_any_column(void **state)
{
    (void)state;
    drawing made;
    drawing_open(&made, &usual, figure_text, "figure,case_id\nf-1,c0\nf-1,c3\n", 1);
    assert_int_equal(made.groups.count, 1);
    assert_int_equal(made.chart.series[0].point_count, 2);
    assert_true(made.chart.series[0].points[0].x == 0.25 &&
                made.chart.series[0].points[0].y == 11.0);
    assert_true(made.chart.series[0].points[1].x == 0.75 &&
                made.chart.series[0].points[1].y == 31.0);
    drawing_close(&made);
}

static const char tornado_text[] =
    "id: f-1\npaper: f\ntitle: t\ncharts:\n"
    "  - id: c\n    kind: tornado\n    title: c\n    x: pixel_density\n    y: frame_ms\n"
    "    ratio_to: a\n    sweep:\n"
    "      - { name: narrow, low: resolve_ms, high: store_ms }\n"
    "      - { name: wide, low: bytes_allocated, high: frame_ms }\n"
    "      - { name: unknown, low: no_such_metric, high: frame_ms }\n";

/* b over a, mean of the two: frame 3, resolve 3, store 113/36, bytes 1/2. */
#define PAIR(of, density, time_ms, own_ms, size)                                                   \
    .method = (of), .k = 4, .pixel_density = (density), .frame_ms = (time_ms),                     \
    .resolve_ms = (own_ms), .bytes = (size)
static const fakes pairs = { { { PAIR("a", 0.25, 10, 1, 100) },
                               { PAIR("b", 0.25, 20, 4, 25) },
                               { PAIR("a", 0.75, 10, 2, 100) },
                               { PAIR("b", 0.75, 40, 4, 75) } } };

static bool nearly(double value, double expected)
{
    return fabs(value - expected) < 1e-6;
}

static void assert_spans(const fm_bar *bar, double from, double to)
{
    if (!nearly(bar->x0, from) || !nearly(bar->x1, to))
        fail_msg("a bar from %g to %g, not %g to %g", bar->x0, bar->x1, from, to);
}

static size_t place_of_label(const fm_chart *chart, const char *text)
{
    for (size_t i = 0; i < chart->label_count; i++)
        if (strcmp(chart->labels[i].text, text) == 0)
            return i;
    fail_msg("no label %s", text);
    return 0;
}

static void tornado_has_the_longest_bar_on_top(void **state)
{
    (void)state;
    drawing made;
    drawing_open(&made, &pairs, tornado_text, NULL, 0);
    assert_int_equal(made.groups.count, 1);
    assert_int_equal(made.chart.bar_count, 4); /* two a parameter, from the defaults' ratio */
    assert_spans(&made.chart.bars[0], 0.5, 3.0);
    assert_spans(&made.chart.bars[1], 3.0, 3.0);
    assert_spans(&made.chart.bars[2], 3.0, 113.0 / 36);
    assert_true(made.chart.bars[0].y0 > made.chart.bars[2].y1);
    assert_true(place_of_label(&made.chart, "wide") < place_of_label(&made.chart, "narrow"));
    assert_true(nearly(made.chart.series[0].points[0].x, 3.0) &&
                nearly(made.chart.series[0].points[1].x, 3.0));
    assert_true(made.chart.x.low < 0.5 && made.chart.x.low > 0.0 && made.chart.x.high > 113.0 / 36);
    assert_string_equal(made.chart.notes[0], "parameters without values: 1");
    drawing_close(&made);
}

static void lines_by_scene_bear_the_scenes_names(void **state)
{
    (void)state;
    drawing made;
    drawing_open(&made, &usual,
                 "id: f-1\npaper: f\ntitle: t\n"
                 "run: { methods: [a, b], scenes: [folder/absent, layers], feeds: [raster] }\n"
                 "charts:\n  - { id: c, title: c, x: scene, y: frame_ms }\n",
                 "figure,case_id\nf-1,c0\nf-1,c2\n", 0);
    assert_int_equal(made.groups.count, 1);
    assert_int_equal(made.chart.label_count, 2);
    assert_string_equal(made.chart.labels[0].text, "absent");
    assert_string_equal(made.chart.labels[1].text, "layers");
    assert_true(made.chart.labels[1].upright);
    assert_true(made.chart.series[0].points[0].x == 2.0);
    assert_true(fabs(made.chart.labels[1].x_px - axis_position(&made.chart.x, 2.0)) < 10);
    assert_int_equal(made.chart.x.tick_count, 2);
    assert_string_equal(made.chart.x.ticks[1].label, "");
    assert_string_equal(made.chart.x.title, "");
    assert_true(made.chart.bottom_px > chart_text_width_px("absent", 11));
    drawing_close(&made);
}

static fm_status read_tornado(const char *keys, fm_error *err)
{
    char directory[64], path[256], text[512];
    fm_paper_figure *figure = NULL;
    kit_make_results(directory, &pairs);
    snprintf(text, sizeof text,
             "id: f-1\npaper: f\ntitle: t\ncharts:\n"
             "  - { id: c, title: c, x: k, y: frame_ms, %s }\n",
             keys);
    kit_write_file(directory, "f-1.yml", text);
    snprintf(path, sizeof path, "%s/f-1.yml", directory);
    const fm_status status = paper_figure_read(&figure, path, err);
    paper_figure_close(figure);
    kit_remove_directory(directory);
    return status;
}

static void tornado_needs_a_sweep_and_nothing_else_does(void **state)
{
    (void)state;
    fm_error err = { 0 };
    assert_int_equal(read_tornado("kind: tornado, ratio_to: a", &err), FM_INVALID);
    assert_non_null(strstr(err.message, "f-1.yml:5: a tornado needs sweep and ratio_to"));
    assert_int_equal(read_tornado("sweep: [{ name: p, low: a, high: b }]", &err), FM_INVALID);
    assert_non_null(strstr(err.message, "sweep is for kind tornado"));
    assert_int_equal(
        read_tornado("kind: tornado, ratio_to: a, sweep: [{ name: p, low: a, hihg: b }]", &err),
        FM_INVALID);
    assert_non_null(strstr(err.message, "high"));
}

static void another_machine_draws_thin_curves(void **state)
{
    (void)state;
    fixture with;
    fm_groups groups;
    fm_chart chart;
    fm_error err = { 0 };
    open_fixture(&with, "figure,case_id\nf-1,c0\nf-1,c3\n");
    fixture_groups(&groups, &with, &with.figure->charts[1]);
    const fm_figure_source own = { with.results, &groups.groups[0] };
    fm_figure_source other = { .results = with.results };
    assert_int_equal(
        figure_reference_group(&other.group, &groups, own.group, &with.figure->charts[1], &err),
        FM_OK);
    assert_ptr_equal(other.group, &groups.groups[0]);
    assert_int_equal(
        figure_chart_make(&chart, with.figure, &with.figure->charts[1], &own, &other, &err), FM_OK);
    assert_int_equal(chart.series_count, 2);
    assert_true(chart.series[1].width_px < 1.0 && !chart.series[1].has_marker);
    assert_string_equal(chart.series[1].label, "");
    assert_string_equal(chart.notes[1], "thin: llvmpipe");
    chart_free(&chart);
    groups_free(&groups);
    fixture_close(&with);
}

static void variants_of_a_method_are_darker(void **state)
{
    (void)state;
    const fm_colour orange = look_family_colour(FM_FAMILY_A_BUFFER);
    const fm_colour same = look_shade(orange, 0);
    assert_memory_equal(&same, &orange, sizeof orange);
    for (size_t i = 1; i < 6; i++)
        assert_true(look_shade(orange, i).r < look_shade(orange, i - 1).r);
}

static void simulated_cases_have_no_chart_of_speed(void **state)
{
    (void)state;
    fm_error err = { 0 };
    fm_chart chart;
    const fm_case_row row = { .is_ok = true, .is_measured = true, .is_simulated = true };
    const fm_case_row *cases[] = { &row };
    const fm_group group = { .cases = cases, .count = 1, .title = "frames" };
    assert_int_equal(speed_error_chart(&chart, &group, error_kind_find(NULL, NULL), &err),
                     FM_UNSUPPORTED);
    assert_non_null(strstr(err.message, "no case has a time"));
    chart_free(&chart);
}

/* What fragmark-report exits with when b must take at most `most` times as long as a. */
static int report_exit(const char *most)
{
    char directory[64], text[1024], command[512];
    kit_make_results(directory, &usual);
    snprintf(text, sizeof text,
             "id: f-1\npaper: f\ntitle: t\ncharts:\n  - { id: c, title: c, x: k, y: frame_ms }\n"
             "claims:\n  - { id: F-1, text: t, required: true, at_most: %s, of: { method: b },"
             " over: { method: a } }\n",
             most);
    kit_write_file(directory, "f-1.yml", text);
    snprintf(command, sizeof command, "%s %s -r none -f %s/f-1.yml >/dev/null 2>&1",
             FM_REPORT_PROGRAM, directory, directory);
    const int status = system(command);
    kit_remove_directory(directory);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

static void required_claim_that_fails_is_exit_code_1(void **state)
{
    (void)state;
    assert_int_equal(report_exit("8"), 0); /* b takes 4 times as long */
    assert_int_equal(report_exit("2"), 1);
}

/* Rows of claims.csv when the folder of this run id is reported beside one of the other id. */
static size_t rows_beside(const char *run_id, const char *other_id)
{
    char own[64], other[64], text[256], command[512], path[128];
    fm_table *claims = NULL;
    kit_make_results(own, &usual);
    kit_make_results(other, &usual);
    snprintf(text, sizeof text, "{\"run_id\": \"%s\"}", run_id);
    kit_write_file(own, "manifest.json", text);
    snprintf(text, sizeof text, "{\"run_id\": \"%s\"}", other_id);
    kit_write_file(other, "manifest.json", text);
    kit_write_file(own, "f-1.yml",
                   "id: f-1\npaper: f\ntitle: t\ncharts:\n"
                   "  - { id: c, title: c, x: k, y: frame_ms }\n"
                   "claims:\n  - { id: F-1, text: t, at_most: 9, of: { method: b },"
                   " over: { method: a } }\n");
    snprintf(command, sizeof command, "%s %s -r %s -f %s/f-1.yml >/dev/null 2>&1",
             FM_REPORT_PROGRAM, own, other, own);
    assert_int_equal(system(command), 0);
    snprintf(path, sizeof path, "%s/claims.csv", own);
    assert_int_equal(table_read(&claims, path, NULL), FM_OK);
    const size_t count = claims->row_count;
    table_close(claims);
    kit_remove_directory(own);
    kit_remove_directory(other);
    return count;
}

static void a_run_is_no_reference_of_itself(void **state)
{
    (void)state;
    assert_int_equal(rows_beside("one", "other"), 2);
    assert_int_equal(rows_beside("one", "one"), 1);
    assert_int_equal(rows_beside("", ""), 2); /* nobody knows */
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(figures_csv_tells_whose_a_case_is),
        cmocka_unit_test(figure_that_figures_csv_does_not_name_takes_nothing),
        cmocka_unit_test(without_figures_csv_a_figure_of_several_runs_takes_all),
        cmocka_unit_test(frames_per_second_follow_from_the_time),
        cmocka_unit_test(grouped_bars_bear_the_papers_marks_of_their_workload),
        cmocka_unit_test(charts_may_run_along_any_column),
        cmocka_unit_test(variants_of_a_method_are_darker),
        cmocka_unit_test(simulated_cases_have_no_chart_of_speed),
        cmocka_unit_test(required_claim_that_fails_is_exit_code_1),
        cmocka_unit_test(a_run_is_no_reference_of_itself),
        cmocka_unit_test(another_machine_draws_thin_curves),
        cmocka_unit_test(lines_by_scene_bear_the_scenes_names),
        cmocka_unit_test(tornado_has_the_longest_bar_on_top),
        cmocka_unit_test(tornado_needs_a_sweep_and_nothing_else_does),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
