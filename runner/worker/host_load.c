#include "host_load.h"

#include <glob.h>
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <unistd.h>

#include "base/clock.h"
#include "base/path.h"

enum { GROUP_BYTES = 1024 };

/* A number of a file's line: the index-th of those after `key`; NAN: it is not there. key "": of
 * the first line. */
static double read_number(const char *path, const char *key, int index)
{
    char line[512];
    double number = NAN;
    FILE *file = fopen(path, "r");
    while (file != NULL && isnan(number) && fgets(line, sizeof line, file) != NULL) {
        const size_t length = strlen(key);
        char *at = line + length, *end = at;
        if (strncmp(line, key, length) != 0 || (length > 0 && *at != ' '))
            continue;
        for (int i = 0; i <= index; i++, at = end) {
            number = strtod(at, &end);
            if (end == at)
                number = NAN;
        }
        if (length == 0)
            break;
    }
    if (file != NULL)
        fclose(file);
    return number;
}

static double sum_of(double a, double b)
{
    return isnan(a) ? b : a + b;
}

/* The first number of each file that the pattern names, put together; NAN: there are none. */
static double fold_files(const char *root, const char *pattern, int index,
                         double (*fold)(double, double))
{
    char path[FM_PATH_MAX_BYTES];
    glob_t files = { 0 };
    double folded = NAN;
    snprintf(path, sizeof path, "%s%s", root, pattern);
    if (glob(path, 0, NULL, &files) == 0)
        for (size_t i = 0; i < files.gl_pathc; i++) {
            const double number = read_number(files.gl_pathv[i], "", index);
            if (!isnan(number))
                folded = fold(folded, number);
        }
    globfree(&files);
    return folded;
}

static double number_in(const char *root, const char *file, const char *key, int index)
{
    char path[FM_PATH_MAX_BYTES];
    snprintf(path, sizeof path, "%s%s", root, file);
    return read_number(path, key, index);
}

/* Linux counts in hundredths of a second: user, nice, system, (idle, waiting for disks,)
 * interrupts, soft interrupts, stolen by the hypervisor. */
static double machine_cpu_s(const char *root)
{
    static const int busy[] = { 0, 1, 2, 5, 6, 7 };
    double ticks = 0.0;
    for (size_t i = 0; i < sizeof busy / sizeof busy[0]; i++)
        ticks += number_in(root, "/proc/stat", "cpu", busy[i]);
    return ticks / (double)sysconf(_SC_CLK_TCK);
}

/* The control group of version 2 that the process is in, as a path that begins with '/'; empty:
 * unknown. In a container it is the topmost one. */
static void own_group(char group[GROUP_BYTES], const char *root)
{
    char path[FM_PATH_MAX_BYTES], line[GROUP_BYTES];
    snprintf(path, sizeof path, "%s/proc/self/cgroup", root);
    FILE *file = fopen(path, "r");
    group[0] = '\0';
    while (file != NULL && fgets(line, sizeof line, file) != NULL)
        if (strncmp(line, "0::/", 4) == 0) {
            line[strcspn(line, "\n")] = '\0';
            strcpy(group, line + 3);
        }
    if (file != NULL)
        fclose(file);
}

/* Control groups of version 2 count microseconds, those of version 1 nanoseconds. The limit may be
 * that of any group from the process's own one up. */
static double throttled_s(const char *root)
{
    char group[GROUP_BYTES], file[GROUP_BYTES + 32];
    double us = NAN;
    own_group(group, root);
    for (bool is_top = false; !is_top;) {
        char *slash = strrchr(group, '/');
        snprintf(file, sizeof file, "/sys/fs/cgroup%s/cpu.stat", group);
        us = fmax(us, number_in(root, file, "throttled_usec", 0)); /* NAN: the other one */
        is_top = slash == NULL;
        if (!is_top)
            *slash = '\0';
    }
    return isnan(us) ? number_in(root, "/sys/fs/cgroup/cpu/cpu.stat", "throttled_time", 0) * 1e-9
                     : us * 1e-6;
}

static double seconds(struct timeval time)
{
    return (double)time.tv_sec + (double)time.tv_usec * 1e-6;
}

double host_load_own_cpu_s(void)
{
    struct rusage usage = { 0 };
    getrusage(RUSAGE_SELF, &usage);
    return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

void host_load_read(fm_host_load *load, const char *root)
{
    static const char cpus[] = "/sys/devices/system/cpu/cpu[0-9]*";
    char pattern[sizeof cpus + 64];
    struct rusage usage = { 0 };
    getrusage(RUSAGE_SELF, &usage);
    *load = (fm_host_load){
        .clock_s = clock_s(),
        .own_cpu_s = host_load_own_cpu_s(),
        .waited_s = fold_files(root, "/proc/self/task/*/schedstat", 1, sum_of) * 1e-9,
        .involuntary_switches = (double)usage.ru_nivcsw,
        .machine_cpu_s = machine_cpu_s(root),
        .throttled_s = throttled_s(root),
        .load = number_in(root, "/proc/loadavg", "", 0),
    };
    snprintf(pattern, sizeof pattern, "%s/thermal_throttle/core_throttle_count", cpus);
    load->thermal_count = fold_files(root, pattern, 0, sum_of);
    snprintf(pattern, sizeof pattern, "%s/cpufreq/scaling_cur_freq", cpus);
    const double slowest = fold_files(root, pattern, 0, fmin);
    snprintf(pattern, sizeof pattern, "%s/cpufreq/cpuinfo_max_freq", cpus);
    load->clock_share = slowest / fold_files(root, pattern, 0, fmax);
}
