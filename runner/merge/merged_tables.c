#include "merged_tables.h"

#include <errno.h>
#include <string.h>
#include <unistd.h>

#include "base/csv.h"
#include "base/file.h"
#include "model/columns.h"

static void add_row(fm_text *text, const fm_table *table, size_t row)
{
    for (size_t i = 0; i < table->column_count; i++) {
        csv_add(text, table_cell(table, row, i));
        text_add(text, i + 1 < table->column_count ? "," : "\n");
    }
}

static void add_names(fm_text *text, const fm_table *table)
{
    for (size_t i = 0; i < table->column_count; i++) {
        csv_add(text, table->names[i]);
        text_add(text, i + 1 < table->column_count ? "," : "\n");
    }
}

/* Writes and frees the text. */
static fm_status write_text(fm_text *text, const char *directory, const char *name, fm_error *err)
{
    char path[FM_PATH_MAX_BYTES];
    fm_status status = path_join(path, directory, name, err);
    if (status == FM_OK)
        status = text->failed ? fm_fail(err, FM_NO_MEMORY, "%s: no memory for its rows", path)
                              : text_write_file(path, text->bytes, text->length, err);
    text_free(text);
    return status;
}

static fm_status write_summary(const shard_set *set, const char *directory, fm_error *err)
{
    fm_text text = { 0 };
    add_names(&text, set->folders[0].summary);
    for (size_t i = 0; i < set->cases->row_count; i++) {
        const shard_row *taken = &set->taken[i];
        if (taken->folder != SHARD_NONE)
            add_row(&text, set->folders[taken->folder].summary, taken->row);
    }
    return write_text(&text, directory, "summary.csv", err);
}

/* What shards.csv tells of a case in a shard. */
static const char *const told[] = {
    "status",          "frame_ms",         "frame_ms_low", "frame_ms_high", "times_floor",
    "times_floor_low", "times_floor_high", "device_name",  "code_driver",   "noisy"
};
enum { TOLD = sizeof told / sizeof told[0] };

static void add_shard_row(fm_text *text, const shard_set *set, size_t folder, size_t row)
{
    const shard_folder *of = &set->folders[folder];
    const size_t index = of->case_of[row];
    if (index == SHARD_NONE)
        return;
    text_add(text, "%s,%u,%s,%d", shard_set_id(set, index), of->index, of->run_id,
             set->taken[index].folder == folder);
    for (size_t i = 0; i < TOLD; i++) {
        text_add(text, ",");
        csv_add(text, table_cell(of->summary, row, table_column(of->summary, told[i])));
    }
    text_add(text, "\n");
}

/* shards.csv: of which shard a case's times are, and what the others measured of it. */
static fm_status write_shards(const shard_set *set, const char *directory, fm_error *err)
{
    fm_text text = { 0 };
    text_add(&text, "case_id,shard,run_id,is_merged");
    for (size_t i = 0; i < TOLD; i++)
        text_add(&text, ",%s", told[i]);
    text_add(&text, "\n");
    for (size_t i = 0; i < set->count; i++)
        for (size_t row = 0; row < set->folders[i].summary->row_count; row++)
            add_shard_row(&text, set, i, row);
    return write_text(&text, directory, "shards.csv", err);
}

static bool is_taken_from(const shard_set *set, size_t folder, const char *case_id)
{
    const size_t index = text_index_find(&set->ids, case_id);
    return index != FM_TEXT_INDEX_NONE && set->taken[index].folder == folder;
}

/* Samples of rows that are merged. is_first: names the columns, too. */
static fm_status add_samples(FILE *file, const shard_set *set, size_t folder, fm_error *err)
{
    char path[FM_PATH_MAX_BYTES];
    fm_table *samples = NULL;
    size_t case_id = 0;
    fm_status status = path_join(path, set->folders[folder].path, "samples.csv", err);
    if (status == FM_OK)
        status = table_read(&samples, path, err);
    if (status == FM_OK)
        status = table_check_schema(samples, FM_SUMMARY_SCHEMA, err);
    if (status == FM_OK)
        status = table_need_column(&case_id, samples, "case_id", err);
    fm_text text = { 0 };
    if (status == FM_OK && folder == 0)
        add_names(&text, samples);
    for (size_t row = 0; status == FM_OK && row < samples->row_count; row++) {
        if (is_taken_from(set, folder, table_cell(samples, row, case_id)))
            add_row(&text, samples, row);
        if (text.length >= 1u << 20 && fwrite(text.bytes, 1, text.length, file) == text.length)
            text.length = 0;
    }
    if (status == FM_OK && text.failed)
        status = fm_fail(err, FM_NO_MEMORY, "%s: no memory for its rows", path);
    if (status == FM_OK && text.length > 0)
        fwrite(text.bytes, 1, text.length, file);
    text_free(&text);
    table_close(samples);
    return status;
}

static fm_status write_samples(const shard_set *set, const char *directory, bool *is_damaged,
                               fm_error *err)
{
    char path[FM_PATH_MAX_BYTES], partial[FM_PATH_MAX_BYTES];
    int fd = -1;
    fm_status status = path_join(path, directory, "samples.csv", err);
    if (status == FM_OK)
        status = path_join(partial, directory, "samples.csv.partial", err);
    if (status == FM_OK)
        status = file_create(&fd, partial, err);
    if (status != FM_OK)
        return status;
    FILE *file = fdopen(fd, "wb");
    if (file == NULL) {
        close(fd);
        return fm_fail(err, FM_NO_MEMORY, "%s: %s", partial, strerror(errno));
    }
    for (size_t i = 0; i < set->count && status == FM_OK; i++)
        status = add_samples(file, set, i, err);
    *is_damaged = status != FM_OK && status != FM_NO_MEMORY; /* read, so far */
    const bool is_written = fflush(file) == 0 && !ferror(file) && fsync(fd) == 0;
    if (status == FM_OK && !is_written)
        status = fm_fail(err, FM_IO, "%s: %s", partial, strerror(errno));
    fclose(file);
    if (status == FM_OK && rename(partial, path) != 0)
        status = fm_fail(err, FM_IO, "%s: %s", path, strerror(errno));
    if (status != FM_OK)
        unlink(partial);
    return status;
}

/* Which figure each case is for: the lines of all shards, in the order of the plan within each
 * figure. */
static fm_status index_figures(fm_text_index *lines, fm_text_list *figures, const shard_set *set,
                               size_t folder, fm_error *err)
{
    char path[FM_PATH_MAX_BYTES], line[256];
    fm_table *table = NULL;
    size_t figure = 0, case_id = 0;
    fm_status status = path_join(path, set->folders[folder].path, "figures.csv", err);
    if (status != FM_OK || access(path, F_OK) != 0)
        return status;
    status = table_read(&table, path, err);
    if (status == FM_OK)
        status = table_need_column(&figure, table, "figure", err);
    if (status == FM_OK)
        status = table_need_column(&case_id, table, "case_id", err);
    for (size_t row = 0; status == FM_OK && row < table->row_count; row++) {
        const char *name = table_cell(table, row, figure);
        snprintf(line, sizeof line, "%.128s,%.64s", name, table_cell(table, row, case_id));
        if (text_index_add(lines, line, 0) == FM_TEXT_INDEX_NONE ||
            (!text_list_has(figures, name) && !text_list_add(figures, name)))
            status = fm_fail(err, FM_NO_MEMORY, "%s: no memory for its rows", path);
    }
    table_close(table);
    return status;
}

static fm_status write_figures(const shard_set *set, const char *directory, bool *is_damaged,
                               fm_error *err)
{
    char line[256];
    fm_text_index lines = { 0 };
    fm_text_list figures = { 0 };
    fm_text text = { 0 };
    fm_status status = FM_OK;
    for (size_t i = 0; i < set->count && status == FM_OK; i++)
        status = index_figures(&lines, &figures, set, i, err);
    *is_damaged = status == FM_INVALID;
    text_add(&text, "figure,case_id\n");
    for (size_t i = 0; i < figures.count && status == FM_OK; i++)
        for (size_t j = 0; j < set->cases->row_count; j++) {
            snprintf(line, sizeof line, "%.128s,%.64s", figures.items[i], shard_set_id(set, j));
            if (text_index_find(&lines, line) != FM_TEXT_INDEX_NONE)
                text_add(&text, "%s\n", line);
        }
    if (status == FM_OK && figures.count > 0)
        status = write_text(&text, directory, "figures.csv", err);
    text_free(&text);
    text_list_free(&figures);
    text_index_free(&lines);
    return status;
}

fm_status merged_tables_write(const shard_set *set, const char *directory, bool *is_damaged,
                              fm_error *err)
{
    *is_damaged = false;
    fm_status status = write_summary(set, directory, err);
    if (status == FM_OK)
        status = write_shards(set, directory, err);
    if (status == FM_OK)
        status = write_samples(set, directory, is_damaged, err);
    return status == FM_OK ? write_figures(set, directory, is_damaged, err) : status;
}
