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

/* The sum of metrics of a case, each as above, with its 95 % interval where they have samples by
 * frame; parts that the case does not have count as 0. All NAN: it has none of them. sample_count:
 * how many frames the interval is made of; 0: the value stands for the case as a whole. */
fm_interval case_interval(size_t *sample_count, const fm_result_files *results,
                          const fm_case_row *result, const char *const *names, size_t name_count);

#endif
