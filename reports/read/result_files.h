/* The result files of one directory, read and checked: manifest.json, summary.csv, samples.csv,
 * and figures.csv and memory.csv where they are. */
#ifndef FM_RESULT_FILES_H
#define FM_RESULT_FILES_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/error.h"
#include "base/stats.h"
#include "model/outcome.h"
#include "provenance.h"
#include "table.h"

/* One row of summary.csv. Numbers are NAN where the cell is empty. */
typedef struct fm_case_row {
    const char *id, *status, *message, *method, *method_version, *device, *device_name, *feed;
    const char *scene, *order, *seed, *options;
    double width_px, height_px, n, k, r, pixel_density, fragment_probability, tessellation;
    double launches, samples, frame_ms, frame_ms_low, frame_ms_high;
    double clear_ms, count_ms, reference_ms, store_ms, resolve_ms, times_floor;
    double bytes_allocated, bytes_predicted, bytes_used;
    double fragments_generated, fragments_stored, fragments_lost, missing, extra, misordered;
    double depth_ulp_max, rmse, psnr_db, max_abs, ssim, flip, truncation_rmse, distinct_images;
    double frame_wall_ms, fragments_per_s;
    double total_rmse;      /* from samples.csv; rmse where the run has none */
    fm_case_status outcome; /* of the word `status` */
    fm_method_info look;
    uint64_t figures; /* bit i: figure_names[i] holds it */
    bool is_ok;
    bool is_measured;  /* has a time, and its error: ok, or wrong_image */
    bool is_simulated; /* feed frames: counts and models, no times */
    bool is_software;  /* the device */
} fm_case_row;

/* The frame of a number that holds for a case as a whole. */
#define FM_SAMPLE_OF_CASE UINT64_MAX

enum { FM_RESULT_FIGURES = 64 };

typedef struct fm_result_files {
    const char *directory; /* borrowed */
    fm_provenance *manifest;
    fm_table *summary, *samples;
    fm_table *figures; /* figures.csv; NULL: there is none */
    fm_table *memory;  /* memory.csv; NULL: there is none */
    const char *figure_names[FM_RESULT_FIGURES];
    size_t figure_count;
    fm_case_row *cases;
    size_t count;
    /* [samples->row_count]: index into cases; UINT32_MAX: none, or marked off_clock */
    uint32_t *sample_case;
    double *sample_value;   /* [samples->row_count] */
    uint64_t *sample_frame; /* the same: launch and frame in one number; FM_SAMPLE_OF_CASE: none */
    size_t sample_metric;   /* column */
    uint32_t *sample_rows;  /* those of a case, case by case */
    size_t *sample_first;   /* [count + 1]: where a case's start in sample_rows */
} fm_result_files;

/* FM_IO: a file cannot be read. FM_INVALID: damaged, naming file and line. The caller closes. */
fm_status result_files_read(fm_result_files **results, const char *directory, fm_error *err);
void result_files_close(fm_result_files *results);

/* The bit of a figure in fm_case_row.figures; 0: figures.csv does not name it. */
uint64_t result_files_figure(const fm_result_files *results, const char *id);

/* The number column of that name; false: there is none. */
bool result_files_number(double *value, const fm_case_row *result, const char *name);

/* Any metric of a case: fps, mib (bytes_allocated) or fps_per_mib, a column of summary.csv, else
 * the median of its samples of that name; NAN when there is none. */
double result_files_metric(const fm_result_files *results, const fm_case_row *result,
                           const char *name);

/* Where a case stands on an axis of that name: the metric, else its option as a number, else NAN.
 */
double result_files_place(const fm_result_files *results, const fm_case_row *result,
                          const char *name);

/* The sum of metrics of a case, each as above, with its 95 % interval where they have samples by
 * frame; parts that the case does not have count as 0. All NAN: it has none of them. sample_count:
 * how many frames the interval is made of; 0: the value stands for the case as a whole. */
fm_interval result_files_interval(size_t *sample_count, const fm_result_files *results,
                                  const fm_case_row *result, const char *const *names,
                                  size_t name_count);

#endif
