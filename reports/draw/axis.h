/* Axes: from values to pixels, and ticks that people read.
 *
 * Pure arithmetic, without VTK: the chart shim is handed pixels, because VTK's SVG device stretches
 * pens and markers under any other transform. */
#ifndef FM_AXIS_H
#define FM_AXIS_H

#include <stdbool.h>
#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

enum {
    FM_AXIS_TICKS = 48,  /* more are left out */
    FM_AXIS_BIN_PX = 56, /* width of the bin for "exact" at the left of a log axis */
};

typedef enum fm_scale { FM_SCALE_LINEAR, FM_SCALE_LOG } fm_scale;

typedef struct fm_tick {
    double value;
    char label[24]; /* "": the tick alone */
} fm_tick;

/* An axis is zero but for title, scale, zero_below and length_px until one of axis_fit fills it. */
typedef struct fm_axis {
    char title[128]; /* with the unit: "frame time [ms]"; "": none */
    fm_scale scale;
    double low, high;  /* what the ends stand for, low < high; LOG: both above 0 */
    double zero_below; /* LOG: values up to this one (and 0) go into a bin of their own at the low
                          end; 0: no bin */
    fm_tick ticks[FM_AXIS_TICKS];
    size_t tick_count;
    double length_px; /* of the plot along this axis */
} fm_axis;

/* Chooses low, high and ticks so that all finite values fit, with room at the ends. On a log axis
 * values at or below zero_below are left out of the range; the bin's tick says "exact".
 * A linear axis starts at 0 when no value is negative. No values: [0, 1], or [0.1, 10]. */
void axis_fit(fm_axis *axis, const double *values, size_t count);

/* Linear, as close around the values as ticks allow, at least a tenth of the greatest wide: for
 * what is compared with a value that is not 0. */
void axis_fit_near(fm_axis *axis, const double *values, size_t count);

/* Replaces the ticks by the distinct values themselves ("4", "8", "16"), when there are at most 12.
 */
void axis_tick_values(fm_axis *axis, const double *values, size_t count);

/* Pixels from the low end, 0 to length_px; values outside the range land on its ends. */
double axis_position(const fm_axis *axis, double value);

/* "0.02", "5", "1e-4", "20000": the shortest that a reader takes in at once. */
void axis_label(char label[24], double value);

#ifdef __cplusplus
}
#endif

#endif
