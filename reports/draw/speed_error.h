/* Speed against error: every measured case of a group as one point, and which cannot be bettered.
 */
#ifndef FM_SPEED_ERROR_H
#define FM_SPEED_ERROR_H

#include "chart.h"
#include "tradeoff/overall.h"

/* Of both charts: the plot, and the letters of labels. */
enum { SPEED_ERROR_WIDTH_PX = 620, SPEED_ERROR_HEIGHT_PX = 400, SPEED_ERROR_LABEL_PX = 10 };

/* x: the error (log, a bin for exact pictures at the left). y: frame_ms with its interval (log).
 * Marker area: bytes_allocated. Grey: dominated (tradeoff/standing.h). Hollow: status is not ok. A
 * line of stairs joins the medians of those that are not dominated and that no faster one betters.
 * Of more than 1000 points only those that are not dominated, and compete, are drawn, which the
 * subtitle says; more than 400 cases have no labels. FM_UNSUPPORTED: nothing to draw. The caller
 * frees *chart. */
fm_status speed_error_chart(fm_chart *chart, const fm_group *group, const fm_error_kind *kind,
                            fm_error *err);

/* Over several workloads, without line and memory: x is the worst error, y the geometric mean of
 * the time over that of the cheapest exact case of each workload. */
fm_status speed_error_overall_chart(fm_chart *chart, const fm_overall *overall,
                                    const fm_error_kind *kind, fm_error *err);

#endif
