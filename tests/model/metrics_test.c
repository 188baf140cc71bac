/* The table of metrics, and the columns made of it. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <stdio.h>
#include <string.h>

#include "model/columns.h"
#include "model/settings.h"

static void metrics_all_have_name_title_and_definition(void **state)
{
    (void)state;
    for (int i = 0; i < FM_METRIC_COUNT; i++) {
        const fm_metric_info *info = &fm_metrics[i];
        assert_non_null(info->name);
        assert_non_null(info->title);
        assert_non_null(info->unit);
        assert_true(info->definition != NULL && info->definition[0] != '\0');
    }
}

static void metrics_are_found_by_name_and_only_once(void **state)
{
    (void)state;
    for (int i = 0; i < FM_METRIC_COUNT; i++) {
        fm_metric found = FM_METRIC_COUNT;
        assert_true(metric_find(&found, fm_metrics[i].name));
        assert_int_equal(found, i);
    }
    fm_metric none = FM_METRIC_SSIM;
    assert_false(metric_find(&none, "ssin"));
    assert_int_equal(none, FM_METRIC_SSIM);
}

static void metrics_of_a_family_are_described_by_it(void **state)
{
    (void)state;
    assert_string_equal(metric_describe("pass.sort_ms")->name, "pass.NAME_ms");
    assert_string_equal(metric_describe("energy.dram_nj")->unit, "nJ");
    assert_string_equal(metric_describe("energy_corner.low_nj")->name, "energy_corner.CORNER_nj");
    assert_string_equal(metric_describe("cycles.raster")->name, "cycles.PART");
    assert_string_equal(metric_describe("store_ms_low")->name, "METRIC_low");
    assert_null(metric_describe("pass._ms"));
    assert_null(metric_describe("pass.sort"));
    assert_null(metric_describe(""));
}

static void metrics_name_the_unit_that_their_name_ends_with(void **state)
{
    (void)state;
    static const struct {
        const char *suffix, *unit;
    } rules[] = { { "_ms", "ms" }, { "_ns", "ns" }, { "_nj", "nJ" }, { "_db", "dB" } };
    for (int i = 0; i < FM_METRIC_COUNT; i++) {
        const char *name = fm_metrics[i].name;
        for (size_t r = 0; r < sizeof rules / sizeof rules[0]; r++) {
            const size_t length = strlen(name), suffix = strlen(rules[r].suffix);
            if (length > suffix && strcmp(name + length - suffix, rules[r].suffix) == 0)
                assert_string_equal(fm_metrics[i].unit, rules[r].unit);
        }
    }
}

static void ends_of_intervals_are_named_after_their_metric(void **state)
{
    (void)state;
    for (size_t i = 0; i < FM_COLUMN_COUNT; i++) {
        const fm_column *column = &fm_columns[i];
        if (column->kind != FM_COLUMN_LOW && column->kind != FM_COLUMN_HIGH)
            continue;
        char name[64];
        snprintf(name, sizeof name, "%s_%s", fm_metrics[column->metric].name,
                 column->kind == FM_COLUMN_LOW ? "low" : "high");
        assert_string_equal(column_name(column), name);
        assert_true(metric_is_time(fm_metrics[column->metric].name));
    }
}

/* A time without an interval beside it would be taken for certain. */
static void every_time_of_the_summary_has_its_interval(void **state)
{
    (void)state;
    for (size_t i = 0; i < FM_COLUMN_COUNT; i++) {
        char low[64], high[64];
        const char *name = column_name(&fm_columns[i]);
        if (fm_columns[i].kind != FM_COLUMN_METRIC || !metric_is_time(name))
            continue;
        snprintf(low, sizeof low, "%s_low", name);
        snprintf(high, sizeof high, "%s_high", name);
        assert_true(summary_has_column(low) && summary_has_column(high));
    }
}

static void columns_have_distinct_names_and_known_keys(void **state)
{
    (void)state;
    for (size_t i = 0; i < FM_COLUMN_COUNT; i++) {
        const char *name = column_name(&fm_columns[i]);
        assert_true(summary_has_column(name));
        if (fm_columns[i].kind == FM_COLUMN_KEY)
            assert_non_null(key_find(name));
        if (fm_columns[i].kind == FM_COLUMN_METRIC)
            assert_int_not_equal(fm_metrics[fm_columns[i].metric].of, FM_OF_REPORT);
        for (size_t j = 0; j < i; j++)
            assert_string_not_equal(name, column_name(&fm_columns[j]));
    }
    assert_false(summary_has_column("floor_store_ms"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(metrics_all_have_name_title_and_definition),
        cmocka_unit_test(metrics_are_found_by_name_and_only_once),
        cmocka_unit_test(metrics_of_a_family_are_described_by_it),
        cmocka_unit_test(metrics_name_the_unit_that_their_name_ends_with),
        cmocka_unit_test(ends_of_intervals_are_named_after_their_metric),
        cmocka_unit_test(every_time_of_the_summary_has_its_interval),
        cmocka_unit_test(columns_have_distinct_names_and_known_keys),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
