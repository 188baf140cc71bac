#include "series.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "sql.h"

static const double usual_level = 0.01;

/* A row while series are put together. Texts are shared: equal ones have one address. */
typedef struct found_row {
    fm_series of; /* what it is a night of */
    fm_series_night night;
    sqlite3_int64 measured;
} found_row;

/* A series and where its nights' launches are found. */
typedef struct growing {
    sqlite3_int64 *measured; /* [count] of the series */
    size_t capacity;
} growing;

typedef struct loader {
    fm_history *history;
    const fm_series_desc *desc;
    fm_series_list *list;
    growing *growing; /* [list->count] */
    sqlite3_stmt *ratios, *share;
    double *values; /* room for the launches of one night */
    size_t value_capacity;
    fm_error *err;
} loader;

static const char select_nights[] =
    "SELECT m.id, m.name, m.title, m.method, fingerprint, m.device_name, m.n, run_id, started,"
    " git_commit, m.case_id, m.status, m.noisy, m.image, m.code_program, m.code_driver,"
    " m.code_plugin, m.code_shaders, m.frame_ms, m.frame_ms_low, m.frame_ms_high,"
    " m.bytes_allocated, m.missing, m.extra, m.misordered, m.max_abs, m.total_rmse"
    " FROM measured m JOIN run ON run.id = m.run JOIN machine ON machine.id = run.machine"
    " WHERE (:machine = '' OR fingerprint = :machine) AND (:wanted = '' OR m.method = :wanted"
    " OR EXISTS(SELECT 1 FROM measured w WHERE (w.case_id = :wanted OR w.title = :wanted)"
    "  AND w.name = m.name AND (w.n IS m.n OR w.n IS NULL OR m.n IS NULL)))"
    " AND (:until = '' OR run_id = :until"
    "  OR started < (SELECT started FROM run WHERE run_id = :until))"
    " ORDER BY started, run.id, m.id";

static const char select_floor_ratios[] =
    "SELECT frame_ms / floor_frame_ms FROM launch WHERE measured = :measured"
    " AND frame_ms > 0 AND floor_frame_ms > 0";

/* Launches of one round: what slows one down for a while does so to both. */
static const char select_method_ratios[] =
    "SELECT a.frame_ms / b.frame_ms FROM launch a JOIN launch b ON b.launch = a.launch"
    " WHERE a.measured = :measured AND a.frame_ms > 0 AND b.frame_ms > 0"
    " AND b.measured = (SELECT r.id FROM measured m JOIN measured r ON r.run = m.run"
    "  WHERE m.id = :measured AND r.method = :reference AND r.is_reference"
    "  AND r.workload = m.workload AND r.device_name = m.device_name"
    "  AND (r.n IS m.n OR r.n IS NULL OR m.n IS NULL)"
    "  AND (r.k IS m.k OR r.k IS NULL OR m.k IS NULL) LIMIT 1)";

static const char select_share[] = "SELECT count(*) FROM measured WHERE floor_ratio IS NOT NULL"
                                   " AND run = (SELECT run FROM measured WHERE id = :measured)";

static found_row read_row(sqlite3_stmt *from)
{
    return (found_row){
        .measured = sqlite3_column_int64(from, 0),
        .of = { .name = sql_text(from, 1),
                .title = sql_text(from, 2),
                .method = sql_text(from, 3),
                .machine = sql_text(from, 4),
                .device_name = sql_text(from, 5),
                .n = sql_real(from, 6) },
        .night = { .run_id = sql_text(from, 7),
                   .started = sql_text(from, 8),
                   .git_commit = sql_text(from, 9),
                   .case_id = sql_text(from, 10),
                   .status = sql_text(from, 11),
                   .noisy = sql_text(from, 12),
                   .image = sql_text(from, 13),
                   .code = { sql_text(from, 14), sql_text(from, 15), sql_text(from, 16),
                             sql_text(from, 17) },
                   .frame_ms = { sql_real(from, 18), sql_real(from, 19), sql_real(from, 20) },
                   .bytes_allocated = sql_real(from, 21),
                   .missing = sql_real(from, 22),
                   .extra = sql_real(from, 23),
                   .misordered = sql_real(from, 24),
                   .max_abs = sql_real(from, 25),
                   .total_rmse = sql_real(from, 26) },
    };
}

/* A case that crashed may not know its device's name, nor how many fragments its mesh has. */
static bool is_of(const fm_series *series, const fm_series *row)
{
    return series->name == row->name && series->machine == row->machine &&
           (series->device_name == row->device_name || series->device_name[0] == '\0' ||
            row->device_name[0] == '\0') &&
           (series->n == row->n || isnan(series->n) || isnan(row->n));
}

/* NULL: no memory. */
static fm_series *find_or_add(loader *to, const fm_series *of)
{
    fm_series_list *list = to->list;
    for (size_t i = 0; i < list->count; i++)
        if (is_of(&list->items[i], of))
            return &list->items[i];
    fm_series *items = realloc(list->items, (list->count + 1) * sizeof *items);
    if (items == NULL)
        return NULL;
    list->items = items;
    growing *grown = realloc(to->growing, (list->count + 1) * sizeof *grown);
    if (grown == NULL)
        return NULL;
    to->growing = grown;
    to->growing[list->count] = (growing){ 0 };
    list->items[list->count] = *of;
    return &list->items[list->count++];
}

static bool make_room(fm_series *series, growing *of)
{
    if (series->count < of->capacity)
        return true;
    const size_t capacity = 2 * of->capacity + 32;
    fm_series_night *nights = realloc(series->nights, capacity * sizeof *nights);
    if (nights == NULL)
        return false;
    series->nights = nights;
    sqlite3_int64 *measured = realloc(of->measured, capacity * sizeof *measured);
    if (measured == NULL)
        return false;
    of->measured = measured;
    of->capacity = capacity;
    return true;
}

static fm_status take_row(loader *to, const found_row *row)
{
    fm_series *series = find_or_add(to, &row->of);
    growing *of = series != NULL ? &to->growing[series - to->list->items] : NULL;
    if (series == NULL || !make_room(series, of))
        return fm_fail(to->err, FM_NO_MEMORY, "no memory for the nights of %zu cases",
                       to->list->count);
    series->title = row->of.title;
    if (series->device_name[0] == '\0')
        series->device_name = row->of.device_name;
    if (isnan(series->n))
        series->n = row->of.n;
    of->measured[series->count] = row->measured;
    series->nights[series->count++] = row->night;
    return FM_OK;
}

static fm_status read_rows(loader *to)
{
    sqlite3_stmt *statement = NULL;
    bool has_row = true;
    fm_status status = sql_prepare(&statement, to->history, select_nights, to->err);
    if (status == FM_OK) {
        sql_bind_text(statement, ":machine", to->desc->machine != NULL ? to->desc->machine : "");
        sql_bind_text(statement, ":wanted", to->desc->wanted != NULL ? to->desc->wanted : "");
        sql_bind_text(statement, ":until", to->desc->until != NULL ? to->desc->until : "");
    }
    while (status == FM_OK && has_row) {
        status = sql_step(&has_row, to->history, statement, to->err);
        if (status != FM_OK || !has_row)
            break;
        const found_row row = read_row(statement);
        status = take_row(to, &row);
    }
    sqlite3_finalize(statement);
    return status;
}

static void keep_last(fm_series *series, growing *of, size_t most)
{
    const size_t dropped = series->count > most ? series->count - most : 0;
    memmove(series->nights, series->nights + dropped,
            (series->count - dropped) * sizeof *series->nights);
    memmove(of->measured, of->measured + dropped, (series->count - dropped) * sizeof *of->measured);
    series->count -= dropped;
}

static fm_status add_value(loader *to, size_t index, double value)
{
    if (index == to->value_capacity) {
        const size_t capacity = 2 * to->value_capacity + 64;
        double *values = realloc(to->values, capacity * sizeof *values);
        if (values == NULL)
            return fm_fail(to->err, FM_NO_MEMORY, "no memory for %zu launches", capacity);
        to->values = values;
        to->value_capacity = capacity;
    }
    to->values[index] = value;
    return FM_OK;
}

static bool is_floor(const char *reference)
{
    return reference == NULL || strcmp(reference, "floor") == 0;
}

static fm_status read_centre(fm_centre *centre, loader *to, sqlite3_int64 measured)
{
    size_t count = 0;
    bool has_row = true;
    fm_status status = FM_OK;
    sql_bind_whole(to->ratios, ":measured", measured);
    if (!is_floor(to->desc->reference))
        sql_bind_text(to->ratios, ":reference", to->desc->reference);
    while (status == FM_OK && has_row) {
        status = sql_step(&has_row, to->history, to->ratios, to->err);
        const double value = status == FM_OK && has_row ? sql_real(to->ratios, 0) : NAN;
        if (isfinite(value) && value > 0)
            status = add_value(to, count++, value);
    }
    sqlite3_reset(to->ratios);
    *centre = centre_of(to->values, count);
    return status;
}

/* values[], index_of[]: room for all nights. */
static fm_status find_steps_in(fm_series *series, double *values, size_t *index_of, double level,
                               fm_error *err)
{
    size_t count = 0;
    const fm_steps_desc desc = { .level = level };
    for (size_t i = 0; i < series->count; i++) {
        if (isnan(series->nights[i].centre.ratio))
            continue;
        index_of[count] = i;
        values[count++] = log(series->nights[i].centre.ratio);
    }
    if (count == 0)
        return FM_OK;
    const fm_status status =
        steps_find(series->steps, &series->step_count, values, count, &desc, err);
    for (size_t i = 0; i < series->step_count && status == FM_OK; i++)
        series->steps[i].index = index_of[series->steps[i].index];
    return status;
}

static fm_status find_steps(fm_series *series, double level, fm_error *err)
{
    size_t *index_of = calloc(series->count + 1, sizeof *index_of);
    double *values = calloc(series->count + 1, sizeof *values);
    series->steps = calloc(series->count + 1, sizeof *series->steps);
    const fm_status status =
        index_of != NULL && values != NULL && series->steps != NULL
            ? find_steps_in(series, values, index_of, level, err)
            : fm_fail(err, FM_NO_MEMORY, "no memory for %zu nights", series->count);
    free(values);
    free(index_of);
    return status;
}

static fm_status judge(fm_series *series, loader *with, sqlite3_int64 last)
{
    bool has_row;
    fm_night *nights = calloc(series->count + 1, sizeof *nights);
    if (nights == NULL)
        return fm_fail(with->err, FM_NO_MEMORY, "no memory for %zu nights", series->count);
    for (size_t i = 0; i < series->count; i++)
        nights[i].ratio = series->nights[i].centre.ratio;
    sql_bind_whole(with->share, ":measured", last);
    fm_status status = sql_step(&has_row, with->history, with->share, with->err);
    const fm_alarm_desc desc = { .series = (size_t)sqlite3_column_int64(with->share, 0) };
    sqlite3_reset(with->share);
    if (status == FM_OK)
        status = alarm_judge(&series->alarm, nights, series->count, &desc, with->err);
    free(nights);
    return status;
}

static fm_status finish_series(loader *to, size_t index)
{
    fm_series *series = &to->list->items[index];
    growing *of = &to->growing[index];
    const size_t most =
        to->desc->most > 0 && to->desc->most < RANK_SUM_VALUES ? to->desc->most : RANK_SUM_VALUES;
    fm_status status = FM_OK;
    keep_last(series, of, most);
    for (size_t i = 0; i < series->count && status == FM_OK; i++)
        status = read_centre(&series->nights[i].centre, to, of->measured[i]);
    if (status == FM_OK)
        status = find_steps(series, to->desc->level > 0 ? to->desc->level : usual_level, to->err);
    return status == FM_OK ? judge(series, to, of->measured[series->count - 1]) : status;
}

static fm_status finish(loader *to)
{
    fm_status status = sql_prepare(
        &to->ratios, to->history,
        is_floor(to->desc->reference) ? select_floor_ratios : select_method_ratios, to->err);
    if (status == FM_OK)
        status = sql_prepare(&to->share, to->history, select_share, to->err);
    for (size_t i = 0; i < to->list->count && status == FM_OK; i++)
        status = finish_series(to, i);
    sqlite3_finalize(to->share);
    sqlite3_finalize(to->ratios);
    return status;
}

const fm_step *series_last_step(const fm_series *series)
{
    return series->step_count > 0 ? &series->steps[series->step_count - 1] : NULL;
}

static int compare_series(const void *left, const void *right)
{
    const fm_series *a = left, *b = right;
    const fm_step *x = series_last_step(a), *y = series_last_step(b);
    if (x == NULL || y == NULL)
        return x == y ? strcmp(a->title, b->title) : x == NULL ? 1 : -1;
    const int newer = strcmp(b->nights[y->index].started, a->nights[x->index].started);
    if (newer != 0)
        return newer;
    return x->shift != y->shift ? (x->shift < y->shift ? 1 : -1) : strcmp(a->title, b->title);
}

/* A column's values, for a name that is none of them. */
static fm_status refuse_name(fm_history *history, const char *what, const char *name,
                             const char *sql, fm_error *err)
{
    fm_text_list names = { 0 };
    sqlite3_stmt *statement = NULL;
    bool has_row = true, is_there = false;
    fm_status status = sql_prepare(&statement, history, sql, err);
    while (status == FM_OK && has_row) {
        status = sql_step(&has_row, history, statement, err);
        if (status == FM_OK && has_row) {
            text_list_add(&names, sql_text(statement, 0));
            is_there |= strcmp(sql_text(statement, 0), name) == 0;
        }
    }
    sqlite3_finalize(statement);
    if (status == FM_OK && !is_there) {
        const char *nearest = text_nearest(name, text_list_items(&names), names.count);
        status = fm_fail(err, FM_UNSUPPORTED, "%s '%.100s' is not in the history%s%s%s", what, name,
                         nearest != NULL ? "; the nearest is '" : "",
                         nearest != NULL ? nearest : "", nearest != NULL ? "'" : "");
    }
    text_list_free(&names);
    return status;
}

static fm_status check_names(fm_history *history, const fm_series_desc *desc, fm_error *err)
{
    fm_status status = FM_OK;
    if (desc->wanted != NULL)
        status = refuse_name(history, "case or method", desc->wanted,
                             "SELECT method FROM measured UNION SELECT case_id FROM measured"
                             " UNION SELECT title FROM measured",
                             err);
    if (status == FM_OK && desc->machine != NULL)
        status =
            refuse_name(history, "machine", desc->machine, "SELECT fingerprint FROM machine", err);
    if (status == FM_OK && desc->until != NULL)
        status = refuse_name(history, "run", desc->until, "SELECT run_id FROM run", err);
    if (status == FM_OK && !is_floor(desc->reference))
        status = refuse_name(history, "reference method", desc->reference,
                             "SELECT DISTINCT method FROM measured", err);
    return status;
}

fm_status history_series(fm_series_list *list, fm_history *history, const fm_series_desc *desc,
                         fm_error *err)
{
    loader to = { .history = history, .desc = desc, .list = list, .err = err };
    *list = (fm_series_list){ 0 };
    fm_status status = check_names(history, desc, err);
    if (status == FM_OK)
        status = read_rows(&to);
    if (status == FM_OK)
        status = finish(&to);
    for (size_t i = 0; i < list->count && to.growing != NULL; i++)
        free(to.growing[i].measured);
    free(to.growing);
    free(to.values);
    if (status == FM_OK && list->count > 0)
        qsort(list->items, list->count, sizeof *list->items, compare_series);
    return status;
}

void history_series_free(fm_series_list *list)
{
    for (size_t i = 0; i < list->count; i++) {
        free(list->items[i].steps);
        free(list->items[i].nights);
    }
    free(list->items);
    *list = (fm_series_list){ 0 };
}
