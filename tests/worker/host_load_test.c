/* What the host tells of its load, read from fabricated files, and from this machine. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/clock.h"
#include "base/text.h"
#include "worker/host_load.h"

/* Writes a file below the folder, and the folders on its way. */
static void put(const char *root, const char *name, const char *text)
{
    char path[256], command[320];
    snprintf(path, sizeof path, "%s%s", root, name);
    snprintf(command, sizeof command, "mkdir -p \"$(dirname '%s')\"", path);
    assert_int_equal(system(command), 0);
    assert_int_equal(text_write_file(path, text, strlen(text), NULL), FM_OK);
}

static void remove_folder(const char *root)
{
    char command[128];
    snprintf(command, sizeof command, "rm -r '%s'", root);
    assert_int_equal(system(command), 0);
}

static void host_load_adds_up_threads_and_processors(void **state)
{
    (void)state;
    char root[] = "/tmp/fragmark-load-XXXXXX";
    fm_host_load load;
    const double tick_s = 1.0 / (double)sysconf(_SC_CLK_TCK);
    assert_non_null(mkdtemp(root));
    put(root, "/proc/stat", "cpu  10 20 30 1000 500 1 2 3 0 0\ncpu0 1 1 1 1 1 1 1 1 0 0\n");
    put(root, "/proc/loadavg", "7.25 2.78 1.06 4/110 24605\n");
    put(root, "/proc/self/task/7/schedstat", "99 1000000000 5\n");
    put(root, "/proc/self/task/8/schedstat", "99 250000000 5\n");
    put(root, "/sys/fs/cgroup/cpu.stat", "usage_usec 9\nnr_throttled 2\nthrottled_usec 1500000\n");
    put(root, "/sys/devices/system/cpu/cpu0/thermal_throttle/core_throttle_count", "3\n");
    put(root, "/sys/devices/system/cpu/cpu1/thermal_throttle/core_throttle_count", "4\n");
    put(root, "/sys/devices/system/cpu/cpu0/cpufreq/scaling_cur_freq", "3000000\n");
    put(root, "/sys/devices/system/cpu/cpu1/cpufreq/scaling_cur_freq", "1000000\n");
    put(root, "/sys/devices/system/cpu/cpu1/cpufreq/cpuinfo_max_freq", "4000000\n");
    host_load_read(&load, root);
    remove_folder(root);
    assert_true(fabs(load.machine_cpu_s - 66 * tick_s) < 1e-9);
    assert_true(load.load == 7.25);
    assert_true(fabs(load.waited_s - 1.25) < 1e-9);
    assert_true(fabs(load.throttled_s - 1.5) < 1e-9);
    assert_true(load.thermal_count == 7.0);
    assert_true(load.clock_share == 0.25);
}

static void host_load_finds_the_limit_of_any_group_above(void **state)
{
    (void)state;
    char root[] = "/tmp/fragmark-load-XXXXXX";
    fm_host_load load;
    assert_non_null(mkdtemp(root));
    put(root, "/proc/self/cgroup", "0::/user.slice/a.scope\n");
    put(root, "/sys/fs/cgroup/cpu.stat", "usage_usec 9\n");
    put(root, "/sys/fs/cgroup/user.slice/cpu.stat", "throttled_usec 2000000\n");
    put(root, "/sys/fs/cgroup/user.slice/a.scope/cpu.stat", "throttled_usec 500000\n");
    host_load_read(&load, root);
    remove_folder(root);
    assert_true(fabs(load.throttled_s - 2.0) < 1e-9);
}

static void host_load_reads_older_control_groups(void **state)
{
    (void)state;
    char root[] = "/tmp/fragmark-load-XXXXXX";
    fm_host_load load;
    assert_non_null(mkdtemp(root));
    put(root, "/sys/fs/cgroup/cpu/cpu.stat", "nr_periods 4\nthrottled_time 250000000\n");
    host_load_read(&load, root);
    remove_folder(root);
    assert_true(fabs(load.throttled_s - 0.25) < 1e-9);
}

static void host_load_does_not_know_what_the_system_does_not_tell(void **state)
{
    (void)state;
    fm_host_load load;
    host_load_read(&load, "/nowhere");
    assert_true(isnan(load.machine_cpu_s) && isnan(load.load) && isnan(load.waited_s));
    assert_true(isnan(load.throttled_s) && isnan(load.thermal_count) && isnan(load.clock_share));
    assert_true(load.own_cpu_s >= 0.0); /* of the process itself the system always tells */
}

static void host_load_counts_the_work_of_this_process(void **state)
{
    (void)state;
    fm_host_load begin, end;
    host_load_read(&begin, "");
    while (host_load_own_cpu_s() < begin.own_cpu_s + 0.05)
        continue;
    host_load_read(&end, "");
    assert_true(end.own_cpu_s - begin.own_cpu_s >= 0.05);
    assert_true(end.clock_s - begin.clock_s >= 0.04); /* one thread, and clocks that are coarse */
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(host_load_adds_up_threads_and_processors),
        cmocka_unit_test(host_load_finds_the_limit_of_any_group_above),
        cmocka_unit_test(host_load_reads_older_control_groups),
        cmocka_unit_test(host_load_does_not_know_what_the_system_does_not_tell),
        cmocka_unit_test(host_load_counts_the_work_of_this_process),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
