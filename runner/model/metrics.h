/* The metrics: every number that fragmark measures, counts or derives, one row each. Who measures,
 * writes, reads, charts or explains a metric takes its name, unit and meaning from here, so that a
 * name is spelled once.
 *
 * Numbers without a row of their own belong to a family (`pass.NAME_ms`, `energy.PART_nj`) or are
 * counters of the simulated GPU (simulator/counters.h). */
#ifndef FM_METRICS_H
#define FM_METRICS_H

#include <stdbool.h>
#include <stddef.h>

typedef enum fm_metric {
    /* times of a frame */
    FM_METRIC_FRAME_MS,
    FM_METRIC_FRAME_WALL_MS,
    FM_METRIC_FRAME_CPU_MS,
    FM_METRIC_CLEAR_MS,
    FM_METRIC_COUNT_MS,
    FM_METRIC_REFERENCE_MS,
    FM_METRIC_STORE_MS,
    FM_METRIC_RESOLVE_MS,
    FM_METRIC_CULLING_MS,
    FM_METRIC_FLOOR_STORE_MS,
    FM_METRIC_FLOOR_FRAME_MS,
    FM_METRIC_CANARY_NS,
    FM_METRIC_OFF_CLOCK,
    /* memory of a case */
    FM_METRIC_BYTES_ALLOCATED,
    FM_METRIC_BYTES_PREDICTED,
    FM_METRIC_BYTES_USED,
    FM_METRIC_BYTES_MOVED,
    FM_METRIC_ATOMICS,
    FM_METRIC_ACCESSES_OUTSIDE,
    /* its fragments */
    FM_METRIC_N,
    FM_METRIC_FRAGMENTS_GENERATED,
    FM_METRIC_FRAGMENTS_ARRIVED,
    FM_METRIC_FRAGMENTS_CULLED,
    FM_METRIC_FRAGMENTS_STORED,
    FM_METRIC_FRAGMENTS_LOST,
    FM_METRIC_NONEMPTY_PIXELS,
    FM_METRIC_TRUTH_DIGEST,
    FM_METRIC_DISCARDED_SHARE,
    FM_METRIC_TAKEN_PER_KEPT,
    FM_METRIC_LOCKS_TAKEN,
    FM_METRIC_PIXELS_REPAIRED,
    FM_METRIC_PIXELS_UNREPAIRED,
    FM_METRIC_CULL_WORDS,
    FM_METRIC_K_CHOSEN,
    FM_METRIC_SCENE_PASSES,
    FM_METRIC_FRAMES_REDONE,
    FM_METRIC_REDONE_MS,
    FM_METRIC_FRAMES_LOSSY,
    /* how wrong its fragments are */
    FM_METRIC_MISSING,
    FM_METRIC_EXTRA,
    FM_METRIC_MISORDERED,
    FM_METRIC_DEPTH_ULP_MAX,
    FM_METRIC_WRONG_PIXELS,
    FM_METRIC_FRAGMENTS_WANTED,
    FM_METRIC_DECLARED_TIES,
    FM_METRIC_DECLARED_AT_ONE,
    FM_METRIC_LOST_TIES,
    FM_METRIC_LOST_AT_ONE,
    /* how wrong its image is */
    FM_METRIC_TIED_PIXELS,
    FM_METRIC_SELF_MAX_ABS,
    FM_METRIC_SELF_BEYOND,
    FM_METRIC_RMSE,
    FM_METRIC_PSNR_DB,
    FM_METRIC_MAX_ABS,
    FM_METRIC_SSIM,
    FM_METRIC_FLIP,
    FM_METRIC_FLIP_MEDIAN,
    FM_METRIC_FLIP_P95,
    FM_METRIC_FLIP_MAX,
    FM_METRIC_COVERED_RMSE,
    FM_METRIC_COVERED_PSNR_DB,
    FM_METRIC_COVERED_MAX_ABS,
    FM_METRIC_COVERED_SSIM,
    FM_METRIC_COVERED_FLIP,
    FM_METRIC_COVERED_FLIP_MEDIAN,
    FM_METRIC_COVERED_FLIP_P95,
    FM_METRIC_COVERED_FLIP_MAX,
    FM_METRIC_TRUNCATION_RMSE,
    FM_METRIC_TOTAL_RMSE,
    FM_METRIC_TOTAL_MAX_ABS,
    FM_METRIC_TOTAL_SSIM,
    FM_METRIC_TOTAL_FLIP,
    FM_METRIC_DISTINCT_IMAGES,
    /* how far frames of one case are apart */
    FM_METRIC_FRAMES_DRAWN,
    FM_METRIC_FRAMES_RMSE_MAX,
    FM_METRIC_FRAMES_MAX_ABS,
    FM_METRIC_FRAMES_TOTAL_RMSE_MAX,
    FM_METRIC_CAPTURED_FRAMES,
    FM_METRIC_DISTINCT_FRAGMENTS,
    FM_METRIC_MISSING_MAX,
    FM_METRIC_IMAGE_ULP_MAX,
    /* what follows from times */
    FM_METRIC_TIMES_FLOOR,
    FM_METRIC_FRAGMENTS_PER_S,
    FM_METRIC_BOUND_MS,
    FM_METRIC_TIMES_BOUND,
    FM_METRIC_DEVICE_BYTES_PER_S,
    FM_METRIC_DEVICE_ATOMICS_PER_S,
    FM_METRIC_DEVICE_FRAGMENTS_PER_S,
    FM_METRIC_LAUNCHES,
    FM_METRIC_SAMPLES,
    FM_METRIC_FPS,
    FM_METRIC_MIB,
    FM_METRIC_FPS_PER_MIB,
    /* the simulated GPU */
    FM_METRIC_CYCLES,
    FM_METRIC_ENERGY_NJ,
    FM_METRIC_WRONG_TILES,
    FM_METRIC_WRONG_FRAMES,
    FM_METRIC_SIMULATED_RATE,
    FM_METRIC_FRAME_CYCLES,
    FM_METRIC_FRAME_ENERGY_NJ,
    FM_METRIC_FRAME_TILES_SKIPPED,
    FM_METRIC_FRAME_FRAGMENTS_SHADED,
    FM_METRIC_FRAME_WRONG_TILES,
    /* how busy the host was, of each launch */
    FM_METRIC_LAUNCH_CPU_S,
    FM_METRIC_TIMED_S,
    FM_METRIC_TIMED_CPU_S,
    FM_METRIC_WAITED_S,
    FM_METRIC_OTHERS_CPU_S,
    FM_METRIC_INVOLUNTARY_SWITCHES,
    FM_METRIC_LOAD_BEGIN,
    FM_METRIC_LOAD_END,
    FM_METRIC_THROTTLED_S,
    FM_METRIC_THERMAL_EVENTS,
    FM_METRIC_CLOCK_SHARE,
    FM_METRIC_COUNT
} fm_metric;

typedef enum fm_better {
    FM_BETTER_NEITHER, /* a fact: neither is better */
    FM_BETTER_LESS,
    FM_BETTER_MORE
} fm_better;

/* What one value of a metric belongs to, and so where it stands. */
typedef enum fm_metric_of {
    FM_OF_FRAME,   /* a timed frame of a launch: rows of samples.csv; summary.csv has the median */
    FM_OF_LAUNCH,  /* a launch: rows of samples.csv without a frame; in a column of summary.csv the
                      largest of all launches */
    FM_OF_CASE,    /* a case: summary.csv, or a row of samples.csv without launch and frame */
    FM_OF_SUMMARY, /* a case, from all its launches: summary.csv alone */
    FM_OF_REPORT   /* a case, worked out when it is charted: no file has it */
} fm_metric_of;

/* Which values a metric can have: what a worker says beyond them is no result. */
typedef enum fm_metric_range {
    FM_RANGE_AMOUNT, /* finite, from 0: times, energies, ratios of such */
    FM_RANGE_COUNT,  /* a whole number that a double holds, from 0 to 2^53 */
    FM_RANGE_BYTES,  /* the same to 2^48: more than any address */
    FM_RANGE_FINITE,
    FM_RANGE_ERROR, /* from 0, or none: pixels of a wrong image may be infinite or no numbers */
    FM_RANGE_LEVEL, /* any number, or none */
    FM_RANGE_KINDS
} fm_metric_range;

typedef struct fm_range {
    double least, most;
    bool is_whole, may_be_none; /* none: not a number */
    const char *words;          /* "a whole number from 0 to 2^53" */
} fm_range;
extern const fm_range fm_ranges[FM_RANGE_KINDS];

typedef struct fm_metric_info {
    const char *name;       /* in files, figures, options of charts: "store_ms" */
    const char *title;      /* in tables and on axes: "store" */
    const char *unit;       /* "ms", "B", "dB"; "" is a plain number */
    const char *definition; /* a sentence for a reader who knows the words of README */
    fm_metric_of of;
    fm_better better;
    bool is_measured; /* it differs from run to run; else the same code gives the same value */
    bool is_timed; /* it hangs on a clock, so that it needs an interval by launches. Other measured
                      numbers are counts: races between fragments change them little. */
    fm_metric_range range;
} fm_metric_info;

extern const fm_metric_info fm_metrics[FM_METRIC_COUNT];

/* A family: all names that begin and end so, such as pass.sort_ms. */
typedef struct fm_metric_family {
    const char *prefix, *suffix;
    fm_metric_info info; /* name: "pass.NAME_ms" */
} fm_metric_family;
enum { FM_METRIC_FAMILY_COUNT = 8 };
extern const fm_metric_family fm_metric_families[FM_METRIC_FAMILY_COUNT];

/* A case of which fewer samples are left, because others were off full clock, is unclear. */
enum { FM_SAMPLES_WANTED = 5 };
/* What a time needs for an interval that is of use. Of two launches it is very wide, of one there
 * is none, and what is claimed of it stays unclear. */
enum { FM_LAUNCHES_WANTED = 3 };

/* false: no metric has this name; *metric is then untouched. */
bool metric_find(fm_metric *metric, const char *name);
/* Whether the name is a time, or a ratio or rate of times: is_timed. */
bool metric_is_time(const char *name);
/* Whether a value can be one of this range. */
bool metric_in_range(fm_metric_range range, double value);
/* The row of a metric, or of the family that the name belongs to; NULL: neither. */
const fm_metric_info *metric_describe(const char *name);

#endif
