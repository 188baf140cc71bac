/* What devices can do, measured: numbers where there is a clock, and only there. */
#include <math.h>

#include "calibrate/calibrate.h"
#include "device/device_kit.h"
#include "plugin/plugin.h"

static fm_device_limits measured(fm_device *device)
{
    fm_plugin_list plugins;
    const fm_plugin *floor;
    fm_device_limits limits;
    fm_error err = { .message = "" };
    if (plugin_list_open(&plugins, NULL, &err) != FM_OK ||
        plugin_list_floor(&floor, &plugins, FM_FEED_RASTER, &err) != FM_OK)
        fail_msg("%s", err.message);
    const calibrate_desc desc = {
        .device = device,
        .floor = floor->method,
        .folders = { .method = floor->folder, .common = plugins.common_folder },
    };
    if (calibrate_device(&limits, &desc, &err) != FM_OK)
        fail_msg("%s", err.message);
    plugin_list_close(&plugins);
    return limits;
}

static void limits_are_numbers_with_intervals(void **state)
{
    fm_device *device = device_of(state);
    const fm_device_limits limits = measured(device);
    const bool has_wide = (device->caps.features & FM_FEATURE_INT64_ATOMICS) != 0;
    assert_string_equal(limits.key.device_name, device->caps.name);
    assert_string_equal(limits.key.driver, device->caps.driver);
    for (int i = 0; i < FM_LIMIT_COUNT; i++) {
        const fm_interval *value = &limits.values[i];
        const bool is_wide = i >= FM_LIMIT_ATOMICS64_OWN && i <= FM_LIMIT_ATOMICS64_ONE;
        if (is_wide && !has_wide) {
            assert_true(isnan(value->median));
            continue;
        }
        if (!(value->median > 0.0) || !isfinite(value->median))
            fail_msg("%s is %g", fm_limits[i].name, value->median);
        if (interval_is_known(value))
            assert_true(value->low <= value->median && value->median <= value->high);
    }
    /* Of any machine that runs this: between 10 MB and 100 TB, 10^5 and 10^13. */
    assert_in_range((uintmax_t)limits.values[FM_LIMIT_COPY].median, 10000000u, 100000000000000u);
    assert_in_range((uintmax_t)limits.values[FM_LIMIT_ATOMICS_OWN].median, 100000u,
                    10000000000000u);
    assert_in_range((uintmax_t)limits.values[FM_LIMIT_RASTER].median, 100000u, 10000000000000u);
}

static int open_dummy(void **state)
{
    *state = open_if_there("dummy", &(fm_device_desc){ .no_timers = true });
    return 0;
}

static void a_device_without_a_clock_has_no_limits(void **state)
{
    const fm_device_limits limits = measured(device_of(state));
    for (int i = 0; i < FM_LIMIT_COUNT; i++)
        assert_true(isnan(limits.values[i].median));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        WITH_TIMERS(limits_are_numbers_with_intervals),
        cmocka_unit_test_setup_teardown(a_device_without_a_clock_has_no_limits, open_dummy,
                                        close_opened),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
