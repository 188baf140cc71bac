#include "calibrate.h"

#include <math.h>
#include <stdio.h>

#include "base/clock.h"
#include "floor.h"
#include "kernels.h"

enum { REPEATS = 11, LEAST_REPEATS = 3, SCALES = 6 };
static const uint64_t warm_ns = 200000000, value_ns = 1000000000; /* by the host's clock */
static const uint64_t long_enough_ns = 5000000; /* beside it a timer's own cost is nothing */
static const double ns_per_s = 1e9;

/* Whatever has frames that are timed. */
typedef struct timed {
    fm_status (*run)(uint64_t *ns, void *of, fm_error *err);
    void *of;
} timed;

static fm_status run_kernel(uint64_t *ns, void *of, fm_error *err)
{
    return kernel_run(ns, of, err);
}

static fm_status run_floor(uint64_t *ns, void *of, fm_error *err)
{
    return floor_run(ns, of, err);
}

/* The clock of a GPU falls in moments without work. A software device has none, and its first frame
 * compiles. */
static fm_status warm_up(const timed *what, const fm_device *device, fm_error *err)
{
    const uint64_t began_ns = clock_ns();
    uint64_t ignored_ns;
    fm_status status = what->run(&ignored_ns, what->of, err);
    while (status == FM_OK && device->caps.has_gpu_clock && clock_ns() - began_ns < warm_ns)
        status = what->run(&ignored_ns, what->of, err);
    return status;
}

/* Nanoseconds of an interval. Those that are 0 are of a device without a clock. */
static fm_status repeat(fm_interval *ns, const timed *what, const fm_device *device, fm_error *err)
{
    double values[REPEATS];
    size_t count = 0;
    uint64_t last_ns = 1;
    fm_status status = warm_up(what, device, err);
    const uint64_t began_ns = clock_ns();
    for (int i = 0; i < REPEATS && status == FM_OK && last_ns > 0; i++) {
        status = what->run(&last_ns, what->of, err);
        values[count] = (double)last_ns;
        count += last_ns > 0;
        if (i + 1 >= LEAST_REPEATS && clock_ns() - began_ns > value_ns)
            break;
    }
    *ns = stats_interval(values, count);
    return status;
}

/* So many units in a time: the slowest repeat has the lowest rate. */
static fm_interval rate_of(double units, const fm_interval *ns)
{
    return (fm_interval){ ns_per_s * units / ns->median, ns_per_s * units / ns->high,
                          ns_per_s * units / ns->low };
}

static fm_status measure_copy(fm_device_limits *limits, fm_device *device, fm_error *err)
{
    kernel copy;
    fm_interval ns = { NAN, NAN, NAN };
    fm_status status = kernel_copy(&copy, device, err);
    if (status == FM_OK)
        status = repeat(&ns, &(timed){ run_kernel, &copy }, device, err);
    limits->values[FM_LIMIT_COPY] = rate_of(copy.units, &ns);
    kernel_free(&copy);
    return status;
}

static const struct atomics_row {
    fm_limit limit;
    uint32_t word_bytes, lanes;
} atomics_rows[] = {
    { FM_LIMIT_ATOMICS_OWN, 4, 1 },      { FM_LIMIT_ATOMICS_GROUP, 4, 32 },
    { FM_LIMIT_ATOMICS_ONE, 4, 0 },      { FM_LIMIT_ATOMICS64_OWN, 8, 1 },
    { FM_LIMIT_ATOMICS64_GROUP, 8, 32 }, { FM_LIMIT_ATOMICS64_ONE, 8, 0 },
};

/* With so many invocations that an interval is long enough, or the most. */
static fm_status measure_atomics(fm_device_limits *limits, fm_device *device,
                                 const struct atomics_row *row, fm_error *err)
{
    fm_interval ns = { NAN, NAN, NAN };
    fm_status status = FM_OK;
    bool is_enough = false;
    for (uint32_t scale = 0; scale < SCALES && status == FM_OK && !is_enough; scale++) {
        kernel atomics;
        uint64_t once_ns = 0;
        status = kernel_atomics(&atomics, device, row->word_bytes, row->lanes, scale, err);
        for (int i = 0; i < 2 && status == FM_OK; i++) /* the first compiles */
            status = kernel_run(&once_ns, &atomics, err);
        is_enough = once_ns >= long_enough_ns || scale + 1 == SCALES || once_ns == 0;
        if (status == FM_OK && is_enough)
            status = repeat(&ns, &(timed){ run_kernel, &atomics }, device, err);
        limits->values[row->limit] = rate_of(atomics.units, &ns);
        kernel_free(&atomics);
    }
    return status;
}

static fm_status measure_dispatch(fm_device_limits *limits, fm_device *device, fm_error *err)
{
    kernel passes;
    fm_interval ns = { NAN, NAN, NAN };
    fm_status status = kernel_dispatch(&passes, device, err);
    if (status == FM_OK)
        status = repeat(&ns, &(timed){ run_kernel, &passes }, device, err);
    limits->values[FM_LIMIT_DISPATCH] =
        (fm_interval){ ns.median / passes.units, ns.low / passes.units, ns.high / passes.units };
    kernel_free(&passes);
    return status;
}

static fm_status measure_timer(fm_device_limits *limits, fm_device *device, fm_error *err)
{
    kernel nothing;
    kernel_timer(&nothing, device);
    return repeat(&limits->values[FM_LIMIT_TIMER], &(timed){ run_kernel, &nothing }, device, err);
}

static fm_status measure_raster(fm_device_limits *limits, const calibrate_desc *desc, fm_error *err)
{
    floor_frames *frames = NULL;
    fm_interval ns = { NAN, NAN, NAN };
    fm_status status = floor_create(&frames, desc, err);
    if (status == FM_OK)
        status = repeat(&ns, &(timed){ run_floor, frames }, desc->device, err);
    if (status == FM_OK)
        limits->values[FM_LIMIT_RASTER] = rate_of(floor_fragments(frames), &ns);
    floor_destroy(frames);
    return status;
}

/* A value that the device cannot have stays empty. */
static fm_status forgive(fm_status status)
{
    return status == FM_UNSUPPORTED ? FM_OK : status;
}

fm_status calibrate_device(fm_device_limits *limits, const calibrate_desc *desc, fm_error *err)
{
    fm_device *device = desc->device;
    *limits = (fm_device_limits){ 0 };
    snprintf(limits->key.device_name, sizeof limits->key.device_name, "%s", device->caps.name);
    snprintf(limits->key.driver, sizeof limits->key.driver, "%s", device->caps.driver);
    for (int i = 0; i < FM_LIMIT_COUNT; i++)
        limits->values[i] = (fm_interval){ NAN, NAN, NAN };
    fm_status status = measure_timer(limits, device, err);
    if (status == FM_OK)
        status = forgive(measure_dispatch(limits, device, err));
    if (status == FM_OK)
        status = forgive(measure_copy(limits, device, err));
    for (size_t i = 0; i < sizeof atomics_rows / sizeof atomics_rows[0] && status == FM_OK; i++)
        status = forgive(measure_atomics(limits, device, &atomics_rows[i], err));
    if (status == FM_OK)
        status = forgive(measure_raster(limits, desc, err));
    return status;
}
