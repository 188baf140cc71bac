/* The result files of one directory, read and checked: manifest.json, summary.csv, samples.csv,
 * and figures.csv and memory.csv where they are. */
#ifndef FM_RESULT_FILES_H
#define FM_RESULT_FILES_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/error.h"
#include "base/stats.h"
#include "provenance.h"
#include "samples.h"
#include "table.h"

enum { FM_RESULT_FIGURES = 64 };

typedef struct fm_result_files {
    const char *directory; /* borrowed */
    fm_provenance *manifest;
    fm_table *summary, *sample_table;
    fm_table *figures; /* figures.csv; NULL: there is none */
    fm_table *memory;  /* memory.csv; NULL: there is none */
    const char *figure_names[FM_RESULT_FIGURES];
    size_t figure_count;
    fm_case_row *cases;
    size_t count;
    fm_sample_rows samples;
} fm_result_files;

/* FM_IO: a file cannot be read. FM_INVALID: damaged, naming file and line. The caller closes. */
fm_status result_files_read(fm_result_files **results, const char *directory, fm_error *err);
void result_files_close(fm_result_files *results);

/* The bit of a figure in fm_case_row.figures; 0: figures.csv does not name it. */
uint64_t result_files_figure(const fm_result_files *results, const char *id);

#endif
