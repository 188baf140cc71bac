/* Speed against error: every measured case of a group as one point, and which cannot be bettered.
 */
#ifndef FM_SPEED_ERROR_H
#define FM_SPEED_ERROR_H

#include "chart.h"
#include "read/group.h"

/* Errors up to this are single-precision rounding: the picture is exact. */
#define FM_EXACT_RMSE 1e-6

/* on[i]: no other candidate is as good as case i of the group in both frame_ms and total_rmse and
 * better in one. Candidates are cases with status ok, a time and an error; controls are not. false:
 * no memory. */
bool speed_error_frontier(bool *on, const fm_group *group);

/* x: total_rmse (log, a bin for exact pictures at the left). y: frame_ms with its interval (log).
 * Marker area: bytes_allocated. Hollow: status is not ok. Of more than 1000 points only those on
 * the frontier are drawn, which the subtitle says; more than 400 cases have no labels.
 * FM_UNSUPPORTED: nothing to draw. The caller frees *chart. */
fm_status speed_error_chart(fm_chart *chart, const fm_group *group, fm_error *err);

#endif
