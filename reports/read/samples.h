/* Rows of samples.csv, by case: numbers of single frames, and numbers of a case as a whole. */
#ifndef FM_READ_SAMPLES_H
#define FM_READ_SAMPLES_H

#include "cases.h"

/* The frame of a number that holds for a case as a whole. */
#define FM_SAMPLE_OF_CASE UINT64_MAX

typedef struct fm_sample_rows {
    const fm_table *table; /* NULL: there is none, and no case has a row */
    size_t metric_column;
    /* Of each row of the table; owned. */
    uint32_t *case_index; /* UINT32_MAX: of no case, or of a frame that is marked off_clock */
    double *value;
    uint64_t *frame; /* launch << 32 | frame; FM_SAMPLE_OF_CASE: none */
    /* Row numbers case by case: rows[first[i]] to rows[first[i + 1] - 1] are those of case i. */
    uint32_t *rows;
    size_t *first;
} fm_sample_rows;

/* Where a case is found by its id. */
typedef struct fm_case_list {
    fm_case_row *cases; /* [count] */
    size_t count;
    const fm_text_index *ids;
} fm_case_list;

/* Also sets total_rmse of the cases that have it. Borrows the table; NULL: no row. Rows of cases
 * that are not in the list, of a stopped run say, are read and left out. FM_INVALID, naming file,
 * line and column: another schema; a column is missing; a launch or frame is no whole number, or a
 * frame has no launch; a row has no metric; a value is no number, or a time is negative or not
 * finite. FM_NO_MEMORY. The caller frees, after a failure too. */
fm_status sample_rows_read(fm_sample_rows *samples, const fm_table *table, const fm_case_list *of,
                           fm_error *err);
void sample_rows_free(fm_sample_rows *samples);

#endif
