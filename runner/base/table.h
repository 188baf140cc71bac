/* CSV as RFC 4180 has it, read strictly: a damaged result file must not become a wrong chart. */
#ifndef FM_TABLE_H
#define FM_TABLE_H

#include <stddef.h>
#include <stdint.h>

#include "path.h"

enum { FM_TABLE_COLUMNS = 256, FM_TABLE_CELL_BYTES = 65536 };
#define FM_TABLE_BYTES     ((size_t)1 << 30)
#define FM_TABLE_NO_COLUMN SIZE_MAX

typedef struct fm_table {
    char path[FM_PATH_MAX_BYTES]; /* for messages */
    size_t column_count, row_count;
    const char **names; /* [column_count] */
    const char **cells; /* [row_count][column_count], "" when empty */
    uint32_t *lines;    /* [row_count]: where each row starts in the file */
    char *bytes;        /* holds all texts */
} fm_table;

/* Reads the file; its first row names the columns. LF and CRLF end rows; a last row may lack its
 * end. FM_IO: cannot be read. FM_INVALID, naming file and line: no header, repeated or empty column
 * names, a row with more or fewer cells than the header, quotes out of place or left open, NUL
 * bytes, cells above FM_TABLE_CELL_BYTES. The caller closes *table. */
fm_status table_read(fm_table **table, const char *path, fm_error *err);
void table_close(fm_table *table);

/* FM_TABLE_NO_COLUMN: no such column. */
size_t table_column(const fm_table *table, const char *name);
/* The same, but FM_INVALID, naming the nearest column, where there is none. */
fm_status table_need_column(size_t *column, const fm_table *table, const char *name, fm_error *err);
const char *table_cell(const fm_table *table, size_t row, size_t column); /* no column: "" */

/* A number; empty is NAN, and "inf", "-inf" and "nan" are what they say. FM_INVALID, naming file,
 * line and column, for all else. */
fm_status table_number(double *value, const fm_table *table, size_t row, size_t column,
                       fm_error *err);

/* The schema of the rows, which a column `schema` tells: each must have the one that is known.
 * FM_INVALID, naming file, line and both. A file without that column is none of a run's. */
fm_status table_check_schema(const fm_table *table, const char *known, fm_error *err);

#endif
