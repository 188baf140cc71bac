/* A chart as data, and the shim that has VTK draw it. No display is needed.
 *
 * The room reports/draw makes charts and pictures. Charts are made in two steps: speed_error and
 * figure_charts fill an fm_chart from cases, chart_svg draws it. Pictures (pictures.h) are the raw
 * images of the runner as PNG, EXR and heat maps. This is the only room that links VTK, OpenImageIO
 * and librsvg, and the only one with C++: chart.cpp and image_file.cpp keep every C++ type and
 * exception to themselves. Nothing here reads result files, judges claims, or writes HTML. */
#ifndef FM_CHART_H
#define FM_CHART_H

#include <stdbool.h>
#include <stddef.h>

#include "axis.h"
#include "look.h"

#ifdef __cplusplus
extern "C" {
#endif

#include "base/error.h"

/* How the points of a series are joined. */
typedef enum fm_stroke {
    FM_STROKE_NONE,
    FM_STROKE_SOLID,
    FM_STROKE_DASHED,
    FM_STROKE_DOTTED,
} fm_stroke;

/* In values of the axes. */
typedef struct fm_point {
    double x, y;
    double low, high; /* of y's interval; NAN: none is drawn */
    double size_px;   /* of the marker; 0: 9 */
} fm_point;

/* A curve, or markers without one. Zero: black, no line, no marker, not in the legend. */
typedef struct fm_series {
    char label[96]; /* legend; empty: not in the legend */
    fm_colour colour;
    fm_stroke stroke;
    double width_px; /* of the line; 0: 1.6 */
    bool has_marker;
    fm_marker marker;
    bool hollow;      /* white inside */
    bool swatch;      /* the legend shows a filled square: the key of bars of that colour */
    fm_point *points; /* point_count, in drawing order; owned by chart_free */
    size_t point_count, point_capacity;
} fm_series;

/* An upright rectangle of one colour, below all series. */
typedef struct fm_bar {
    double x0, x1, y0, y1; /* in values of the axes */
    fm_colour colour;
} fm_bar;

/* Which part of a text stands at its place. */
typedef enum fm_anchor { FM_ANCHOR_START, FM_ANCHOR_MIDDLE, FM_ANCHOR_END } fm_anchor;

/* A text at pixels from the lower left corner of the plot; may lie outside of it. */
typedef struct fm_label {
    double x_px, y_px;
    int size_px; /* 0: 11 */
    fm_anchor anchor;
    bool upright; /* turned by 90 degrees, read from below */
    char text[64];
} fm_label;

enum { FM_CHART_NOTES = 6 };

/* A chart. Starts as zero, with length_px of both axes set: the size of the plot. Texts that are
 * too long for their room are cut. Whoever fills a chart frees it with chart_free. */
typedef struct fm_chart {
    char title[160];
    char subtitle[200];
    fm_axis x, y;
    int bottom_px;     /* room below the plot; 0: 62 */
    int left_px;       /* room left of it; 0: 74 */
    fm_series *series; /* owned */
    size_t series_count, series_capacity;
    fm_bar *bars; /* owned */
    size_t bar_count, bar_capacity;
    fm_label *labels; /* owned */
    size_t label_count, label_capacity;
    char notes[FM_CHART_NOTES][64]; /* lines below the legend, up to the first empty one */
    bool failed;                    /* out of memory while it was built: chart_svg will say so */
} fm_chart;

/* Each adds one zeroed entry. NULL when out of memory, which is remembered in `failed`: callers may
 * then go on without it. The pointer holds until the next one of its kind is added. */
fm_series *chart_add_series(fm_chart *chart);
fm_bar *chart_add_bar(fm_chart *chart);
fm_label *chart_add_label(fm_chart *chart);
/* Adds a point at the end of a series of this chart. Out of memory is remembered in `failed`. */
void chart_add_point(fm_chart *chart, fm_series *series, const fm_point *point);
/* Frees what the chart owns, and makes it zero. */
void chart_free(fm_chart *chart);

/* The chart as SVG text without ids, so that many fit into one page; the caller frees *svg, which
 * is NULL on failure. FM_NO_MEMORY, also if the chart `failed`; FM_INVALID: VTK could not draw it.
 */
fm_status chart_svg(char **svg, const fm_chart *chart, fm_error *err);

/* Width in pixels of a text as charts draw it. */
double chart_text_width_px(const char *text, int size_px);

#ifdef __cplusplus
}
#endif

#endif
