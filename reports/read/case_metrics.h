/* Numbers of a case: columns of summary.csv, medians and intervals of its samples, and what follows
 * from them. */
#ifndef FM_READ_CASE_METRICS_H
#define FM_READ_CASE_METRICS_H

#include "base/stats.h"
#include "result_files.h"

/* Any metric of a case: fps, mib (bytes_allocated) or fps_per_mib, a column of summary.csv, else
 * the median of its samples of that name; NAN when there is none. */
double case_metric(const fm_result_files *results, const fm_case_row *result, const char *name);

/* Where a case stands on an axis of that name: the metric, else its option as a number, else NAN.
 */
double case_place(const fm_result_files *results, const fm_case_row *result, const char *name);

/* The sum of metrics of a case, each as above; parts that the case does not have count as 0. All
 * NAN: it has none of them. Times have the 95 % interval of their launches (base/stats.h), and none
 * if there was one launch; other numbers are exact. */
fm_interval case_interval(const fm_result_files *results, const fm_case_row *result,
                          const char *const *names, size_t name_count);

#endif
