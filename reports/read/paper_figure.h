/* What a report needs of a figure's file (model/figure_file.h): its charts and the paper's points.
 *
 *   charts:                    in the report's order
 *     - id: time               part of the file name charts/ID-time-*.svg
 *       kind: lines            or stacked-bars, grouped-bars, tornado
 *       title: ...
 *       x: k                   a number column of summary.csv, an option, or scene: a place
 *                              for each scene that the run lists, under its name
 *                              tornado: what the mean is over
 *       y: frame_ms            lines, grouped-bars: any metric, or a list whose sum is drawn
 *                              tornado: the metric with all parameters at their defaults
 *       parts: [clear_ms, ...] stacked-bars: metrics, from the bottom up
 *       sweep:                 tornado: for each parameter y with it alone at its lowest, and at
 *                              its highest value: a horizontal bar from one ratio to the other,
 *                              the longest on top; the line across is the defaults' ratio
 *         - { name: dram_latency_cycles, low: METRIC, high: METRIC }
 *       ratio_to: kplus-array  lines: y over that method's at the same x
 *                              tornado: the mean of that
 *       with_paper: true       lines, grouped-bars: the paper's points, hollow
 *       across: [height_px]    columns that change with x
 *       y_scale: log           or linear, the default
 *   paper_points:
 *     metric: fps              what the points are; frame_ms is the default, which ratio_to
 *                              takes too
 *     parts: [store_ms, resolve_ms]
 *     series:
 *       - method: kplus-array
 *         title: Array         as the paper's legend has it
 *         at: { n: 16 }        of which workload, where the figure has several
 *         points: [[4, 3.9, 0.2], ...]   x, then one value a part
 *
 * Unknown keys are refused with file, line and the nearest known one. */
#ifndef FM_PAPER_FIGURE_H
#define FM_PAPER_FIGURE_H

#include <stdbool.h>
#include <stddef.h>

#include "claim.h"
#include "model/figure_file.h"

enum {
    FM_FIGURE_CHARTS = 8,
    FM_FIGURE_PARTS = 8,
    FM_FIGURE_SWEPT = 16,
    FM_FIGURE_POINTS = 256,
};

typedef enum fm_figure_kind {
    FM_FIGURE_LINES,
    FM_FIGURE_STACKED_BARS,
    FM_FIGURE_GROUPED_BARS,
    FM_FIGURE_TORNADO,
} fm_figure_kind;

/* A parameter of a model, and the metrics at the ends of its range. */
typedef struct fm_figure_swept {
    const char *name, *low, *high;
} fm_figure_swept;

typedef struct fm_figure_chart {
    const char *id, *title, *x;
    const char *y;             /* the first of ys */
    fm_text_list ys;           /* summed */
    const char *ratio_to;      /* NULL: none */
    fm_text_list free_columns; /* in which its cases differ: `across`, and x at last */
    fm_figure_kind kind;
    fm_text_list parts;
    fm_figure_swept sweep[FM_FIGURE_SWEPT];
    size_t swept_count;
    bool with_paper, is_log;
} fm_figure_chart;

typedef struct fm_paper_point {
    const char *method, *title;
    const fm_yaml *at; /* numbers by column; NULL: everywhere */
    double x, value;   /* the sum of its parts */
} fm_paper_point;

typedef struct fm_paper_figure {
    const char *id, *paper, *title, *source;
    fm_text_list methods, scenes, feeds; /* of `run`; empty: all */
    fm_text_list own_scenes;             /* of all blocks of `run` and `large`; empty: all */
    bool has_table;                      /* of memory: its rows are in memory.csv */
    fm_text_list deviations;
    fm_figure_chart charts[FM_FIGURE_CHARTS];
    size_t chart_count;
    fm_paper_point points[FM_FIGURE_POINTS];
    size_t point_count;
    const char *points_metric;
    fm_claim *claims; /* owned */
    size_t claim_count;
    fm_figure_file file; /* owned; holds all texts */
} fm_paper_figure;

/* FM_IO, FM_NO_MEMORY; FM_INVALID: naming file and line. The caller closes *figure. */
fm_status paper_figure_read(fm_paper_figure **figure, const char *path, fm_error *err);
void paper_figure_close(fm_paper_figure *figure);

#endif
