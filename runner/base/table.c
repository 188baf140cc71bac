#include "table.h"

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "text.h"

/* Where the reader is; cells are unquoted in place, so `write` never passes `read`. */
typedef struct reader {
    const char *path;
    char *read, *end, *write;
    uint32_t line;
    bool row_ended;
} reader;

static fm_status read_quoted(reader *in, fm_error *err)
{
    uint32_t opened = in->line;
    in->read++;
    while (in->read < in->end) {
        bool is_quote = *in->read == '"';
        if (is_quote && (in->read + 1 == in->end || in->read[1] != '"')) {
            in->read++;
            return FM_OK;
        }
        in->read += is_quote; /* two quotes stand for one */
        in->line += *in->read == '\n';
        *in->write++ = *in->read++;
    }
    return fm_fail(err, FM_INVALID, "%s:%u: a quote is opened and never closed", in->path, opened);
}

static fm_status read_plain(reader *in, fm_error *err)
{
    for (; in->read < in->end && *in->read != ',' && *in->read != '\n'; in->read++) {
        if (*in->read == '\r' && in->read + 1 < in->end && in->read[1] == '\n')
            break;
        if (*in->read == '"')
            return fm_fail(err, FM_INVALID, "%s:%u: a quote inside an unquoted cell", in->path,
                           in->line);
        *in->write++ = *in->read;
    }
    return FM_OK;
}

/* One cell and what ends it. The terminating NUL may overwrite the separator, never text ahead. */
static fm_status read_cell(char **cell, reader *in, fm_error *err)
{
    char *start = in->write;
    fm_status status =
        in->read < in->end && *in->read == '"' ? read_quoted(in, err) : read_plain(in, err);
    if (status != FM_OK)
        return status;
    if (in->write - start > FM_TABLE_CELL_BYTES)
        return fm_fail(err, FM_INVALID, "%s:%u: a cell of more than %d bytes", in->path, in->line,
                       FM_TABLE_CELL_BYTES);
    if (in->read < in->end && *in->read == '\r')
        in->read++;
    in->row_ended = in->read == in->end || *in->read == '\n';
    if (!in->row_ended && *in->read != ',')
        return fm_fail(err, FM_INVALID, "%s:%u: text after a closing quote", in->path, in->line);
    in->line += in->read < in->end && *in->read == '\n';
    in->read += in->read < in->end;
    *in->write++ = '\0';
    *cell = start;
    return FM_OK;
}

static fm_status read_header(fm_table *table, reader *in, fm_error *err)
{
    const char *names[FM_TABLE_COLUMNS] = { NULL };
    size_t count = 0;
    do {
        char *name = NULL;
        if (count == FM_TABLE_COLUMNS)
            return fm_fail(err, FM_INVALID, "%s:1: more than %d columns", in->path,
                           FM_TABLE_COLUMNS);
        fm_status status = read_cell(&name, in, err);
        if (status != FM_OK)
            return status;
        if (name == NULL || name[0] == '\0')
            return fm_fail(err, FM_INVALID, "%s:1: column %zu has no name", in->path, count + 1);
        for (size_t i = 0; i < count; i++)
            if (strcmp(names[i], name) == 0)
                return fm_fail(err, FM_INVALID, "%s:1: column \"%s\" appears twice", in->path,
                               name);
        names[count++] = name;
    } while (!in->row_ended);
    table->names = calloc(count, sizeof *table->names);
    if (table->names == NULL)
        return fm_fail(err, FM_NO_MEMORY, "%s: header", in->path);
    memcpy(table->names, names, count * sizeof names[0]);
    table->column_count = count;
    return FM_OK;
}

static fm_status read_row(fm_table *table, reader *in, fm_error *err)
{
    uint32_t line = in->line;
    const char **cells = table->cells + table->row_count * table->column_count;
    size_t count = 0;
    do {
        char *cell = NULL;
        fm_status status = read_cell(&cell, in, err);
        if (status != FM_OK)
            return status;
        if (count < table->column_count)
            cells[count] = cell;
        count++;
    } while (!in->row_ended);
    if (count != table->column_count)
        return fm_fail(err, FM_INVALID, "%s:%u: %zu cells where the header has %zu", in->path, line,
                       count, table->column_count);
    table->lines[table->row_count++] = line;
    return FM_OK;
}

/* Every row ends with a line feed or the end of the file, so line feeds bound the rows. */
static fm_status reserve_rows(fm_table *table, const reader *in, fm_error *err)
{
    size_t rows = 1;
    for (const char *at = in->read; at < in->end; at++)
        rows += *at == '\n';
    if (rows > SIZE_MAX / sizeof *table->cells / table->column_count)
        return fm_fail(err, FM_NO_MEMORY, "%s: %zu rows", in->path, rows);
    table->cells = calloc(rows * table->column_count, sizeof *table->cells);
    table->lines = calloc(rows, sizeof *table->lines);
    if (table->cells == NULL || table->lines == NULL)
        return fm_fail(err, FM_NO_MEMORY, "%s: %zu rows", in->path, rows);
    return FM_OK;
}

static fm_status read_all(fm_table *table, size_t byte_count, fm_error *err)
{
    reader in = { .path = table->path,
                  .read = table->bytes,
                  .write = table->bytes,
                  .end = table->bytes + byte_count,
                  .line = 1 };
    if (byte_count == 0)
        return fm_fail(err, FM_INVALID, "%s:1: the file is empty; a header is needed", table->path);
    if (memchr(table->bytes, '\0', byte_count) != NULL)
        return fm_fail(err, FM_INVALID, "%s: holds NUL bytes; it is not text", table->path);
    fm_status status = read_header(table, &in, err);
    if (status == FM_OK)
        status = reserve_rows(table, &in, err);
    while (status == FM_OK && in.read < in.end)
        status = read_row(table, &in, err);
    return status;
}

fm_status table_read(fm_table **table, const char *path, fm_error *err)
{
    size_t byte_count = 0;
    *table = NULL;
    fm_table *made = calloc(1, sizeof *made);
    if (made == NULL)
        return fm_fail(err, FM_NO_MEMORY, "%s", path);
    snprintf(made->path, sizeof made->path, "%s", path);
    fm_status status = text_read_file(&made->bytes, &byte_count, path, FM_TABLE_BYTES, err);
    if (status == FM_OK)
        status = read_all(made, byte_count, err);
    if (status != FM_OK) {
        table_close(made);
        return status;
    }
    *table = made;
    return FM_OK;
}

void table_close(fm_table *table)
{
    if (table == NULL)
        return;
    free(table->names);
    free(table->cells);
    free(table->lines);
    free(table->bytes);
    free(table);
}

size_t table_column(const fm_table *table, const char *name)
{
    for (size_t i = 0; i < table->column_count; i++)
        if (strcmp(table->names[i], name) == 0)
            return i;
    return FM_TABLE_NO_COLUMN;
}

const char *table_cell(const fm_table *table, size_t row, size_t column)
{
    return column == FM_TABLE_NO_COLUMN ? "" : table->cells[row * table->column_count + column];
}

fm_status table_number(double *value, const fm_table *table, size_t row, size_t column,
                       fm_error *err)
{
    const char *text = table_cell(table, row, column);
    *value = NAN;
    if (text[0] == '\0' || strcmp(text, "nan") == 0 || strcmp(text, "-nan") == 0)
        return FM_OK;
    if (strcmp(text, "inf") == 0 || strcmp(text, "-inf") == 0) {
        *value = text[0] == '-' ? -INFINITY : INFINITY;
        return FM_OK;
    }
    if (!text_to_double(value, text))
        return fm_fail(err, FM_INVALID, "%s:%u: %s: \"%.80s\" is not a number", table->path,
                       table->lines[row], table->names[column], text);
    return FM_OK;
}

fm_status table_check_schema(const fm_table *table, const char *known, fm_error *err)
{
    size_t column;
    fm_status status = table_need_column(&column, table, "schema", err);
    for (size_t row = 0; row < table->row_count && status == FM_OK; row++)
        if (strcmp(table_cell(table, row, column), known) != 0)
            status =
                fm_fail(err, FM_INVALID, "%s:%u: schema: \"%.40s\"; this program reads schema %s",
                        table->path, table->lines[row], table_cell(table, row, column), known);
    return status;
}

fm_status table_need_column(size_t *column, const fm_table *table, const char *name, fm_error *err)
{
    *column = table_column(table, name);
    if (*column != FM_TABLE_NO_COLUMN)
        return FM_OK;
    const char *nearest = text_nearest(name, table->names, table->column_count);
    return fm_fail(err, FM_INVALID, "%s:1: no column \"%s\"%s%s%s", table->path, name,
                   nearest == NULL ? "" : " (there is \"", nearest == NULL ? "" : nearest,
                   nearest == NULL ? "" : "\")");
}
