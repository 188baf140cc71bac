/* Cases under what their devices allow. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "roofline/roofline.h"

/* A case of a device with limits, unless bytes_per_s is 0. */
typedef struct fake {
    const char *method, *device_name;
    double times_bound, bytes_moved, per_s, bytes_per_s;
    bool is_control;
} fake;

static fm_case_row row_of(const fake *one)
{
    fm_case_row row = { .id = one->method,
                        .status = "ok",
                        .message = "",
                        .method = one->method,
                        .device = "vulkan",
                        .device_name = one->device_name,
                        .feed = "raster",
                        .scene = "layers",
                        .options = "",
                        .limited_by = "bytes",
                        .k = 8,
                        .look = { .title = one->method, .is_control = one->is_control },
                        .is_ok = true,
                        .is_measured = true };
    for (int i = 0; i < FM_METRIC_COUNT; i++)
        row.metric[i] = row.low[i] = row.high[i] = NAN;
    row.metric[FM_METRIC_TIMES_BOUND] = one->times_bound;
    row.metric[FM_METRIC_BYTES_MOVED] = one->bytes_moved;
    row.metric[FM_METRIC_FRAGMENTS_GENERATED] = 1000;
    row.metric[FM_METRIC_FRAGMENTS_PER_S] = one->per_s;
    if (one->bytes_per_s > 0)
        row.metric[FM_METRIC_DEVICE_BYTES_PER_S] = one->bytes_per_s;
    row.metric[FM_METRIC_DEVICE_FRAGMENTS_PER_S] = 1e9;
    return row;
}

enum { ROWS = 7 };
static const fake fakes[ROWS] = {
    { "slow", "one", 9.0, 64000, 1e6, 1e9, false },
    { "fast", "one", 2.0, 16000, 1e7, 1e9, false },
    { "control", "one", 1.0, 0, 1e8, 1e9, true },
    { "elsewhere", "two", 3.0, 16000, 1e7, 1e9, false },
    { "uncalibrated", "three", NAN, 16000, 1e7, 0, false },
    { "uncounted", "one", 4.0, NAN, 1e7, 1e9, false },
    { "other-machine", "one", 5.0, 16000, 1e7, 2e9, false },
};

static void fill(fm_case_row rows[ROWS], fm_result_files *results)
{
    for (size_t i = 0; i < ROWS; i++)
        rows[i] = row_of(&fakes[i]);
    *results = (fm_result_files){ .cases = rows, .count = ROWS };
}

static void cases_are_parted_by_device_and_its_limits(void **state)
{
    fm_case_row rows[ROWS];
    fm_result_files results;
    fm_rooflines made;
    (void)state;
    fill(rows, &results);
    assert_int_equal(rooflines_make(&made, &results, NULL), FM_OK);
    assert_int_equal(made.count, 3);
    assert_string_equal(made.items[0].device_name, "one");
    assert_int_equal(made.items[0].count, 3); /* slow, fast, uncounted */
    assert_string_equal(made.items[1].device_name, "two");
    assert_true(made.items[2].bytes_per_s == 2e9);
    rooflines_free(&made);
}

static void tables_begin_with_the_nearest_to_the_bound(void **state)
{
    fm_case_row rows[ROWS];
    fm_result_files results;
    fm_rooflines made;
    (void)state;
    fill(rows, &results);
    assert_int_equal(rooflines_make(&made, &results, NULL), FM_OK);
    const fm_case_row **sorted = roofline_sorted(&made.items[0]);
    assert_non_null(sorted);
    assert_string_equal(sorted[0]->method, "fast");
    assert_string_equal(sorted[1]->method, "uncounted");
    assert_string_equal(sorted[2]->method, "slow");
    free(sorted);
    rooflines_free(&made);
}

static const fm_series *series_of(const fm_chart *chart, const char *beginning)
{
    for (size_t i = 0; i < chart->series_count; i++)
        if (strncmp(chart->series[i].label, beginning, strlen(beginning)) == 0)
            return &chart->series[i];
    fail_msg("no series '%s'", beginning);
    return NULL;
}

static void the_roof_of_copying_falls_with_the_bytes(void **state)
{
    fm_case_row rows[ROWS];
    fm_result_files results;
    fm_rooflines made;
    fm_chart chart;
    char *svg = NULL;
    fm_error err = { .message = "" };
    (void)state;
    fill(rows, &results);
    assert_int_equal(rooflines_make(&made, &results, NULL), FM_OK);
    assert_int_equal(roofline_chart(&chart, &made.items[0], &err), FM_OK);
    const fm_series *copying = series_of(&chart, "copying, 1 GB/s");
    for (size_t i = 0; i < copying->point_count; i++)
        assert_true(fabs(copying->points[i].x * copying->points[i].y - 1e9) < 1.0);
    const fm_series *raster = series_of(&chart, "raster");
    assert_true(raster->points[0].y == 1e9 && raster->points[1].y == 1e9);
    const fm_series *fast = series_of(&chart, "fast");
    assert_int_equal(fast->point_count, 1);
    assert_true(fast->points[0].x == 16.0 && fast->points[0].y == 1e7);
    if (chart_svg(&svg, &chart, &err) != FM_OK)
        fail_msg("%s", err.message);
    assert_non_null(strstr(svg, "What the device allows: one"));
    free(svg);
    chart_free(&chart);
    rooflines_free(&made);
}

static void without_counts_there_is_no_chart(void **state)
{
    fm_case_row row = row_of(&fakes[5]);
    fm_result_files results = { .cases = &row, .count = 1 };
    fm_rooflines made;
    fm_chart chart;
    fm_error err = { .message = "" };
    (void)state;
    assert_int_equal(rooflines_make(&made, &results, NULL), FM_OK);
    assert_int_equal(roofline_chart(&chart, &made.items[0], &err), FM_UNSUPPORTED);
    assert_non_null(strstr(err.message, "accesses"));
    chart_free(&chart);
    rooflines_free(&made);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(cases_are_parted_by_device_and_its_limits),
        cmocka_unit_test(tables_begin_with_the_nearest_to_the_bound),
        cmocka_unit_test(the_roof_of_copying_falls_with_the_bytes),
        cmocka_unit_test(without_counts_there_is_no_chart),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
