/* The result files of a run, read and checked.
 *
 * The room reports/read turns files into data: result files (this header, cases.h, samples.h,
 * provenance.h), figure files and their claims (paper_figure.h, claim.h), and kept
 * pictures (picture.h). It also answers what all readers ask of cases: their numbers
 * (case_metrics.h), options and workloads, and which of them may stand in one chart (group.h). A
 * damaged file is refused here with its line; the rooms above need not check again. Nothing here
 * draws, judges, or writes a file, and nothing here links VTK, OpenImageIO or librsvg. */
#ifndef FM_RESULT_FILES_H
#define FM_RESULT_FILES_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/error.h"
#include "base/table.h"
#include "base/text.h"
#include "provenance.h"
#include "samples.h"

enum { FM_RESULT_FIGURES = 64 }; /* a bit each in fm_case_row.figures */

/* One run. Everything in it lives until it is closed, and so do all texts that it hands out. */
typedef struct fm_result_files {
    const char *directory; /* borrowed: it must live as long */
    fm_provenance *manifest;
    fm_table *summary;      /* summary.csv */
    fm_table *sample_table; /* samples.csv; NULL: there is none, which `missing` says */
    fm_table *figures;      /* figures.csv: which figure a case is for; NULL: there is none */
    fm_table *memory;       /* memory.csv: tables of memory by formula; NULL: there is none */
    const char *figure_names[FM_RESULT_FIGURES]; /* [figure_count], as figures.csv has them */
    size_t figure_count;
    fm_case_row *cases; /* [count]: the rows of summary.csv, in its order */
    fm_text_index ids;  /* of the cases */
    size_t count;
    fm_sample_rows samples;
    fm_text_list missing; /* sentences: what a run should have left and did not, or what is damaged
                             that results can do without */
} fm_result_files;

/* Reads DIRECTORY/manifest.json and summary.csv, which must be there, and samples.csv, figures.csv
 * and memory.csv where they are. A journal is looked at, not read. FM_IO: a file cannot be read.
 * FM_INVALID: damaged, naming file and line; a path that is too long; more than FM_RESULT_FIGURES
 * figures. FM_NO_MEMORY. On failure *results is NULL. The caller closes it. */
fm_status result_files_read(fm_result_files **results, const char *directory, fm_error *err);
/* Takes NULL too. */
void result_files_close(fm_result_files *results);

/* The bit of a figure in fm_case_row.figures; 0: figures.csv does not name it. */
uint64_t result_files_figure(const fm_result_files *results, const char *id);

#endif
