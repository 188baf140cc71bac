#include "sql.h"

#include <assert.h>
#include <math.h>

#include "base/text.h"

static fm_status status_of(int code)
{
    switch (code & 0xff) {
    case SQLITE_NOMEM:
        return FM_NO_MEMORY;
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
    case SQLITE_IOERR:
    case SQLITE_FULL:
    case SQLITE_CANTOPEN:
    case SQLITE_READONLY:
    case SQLITE_PERM:
    case SQLITE_AUTH:
        return FM_IO;
    default: /* no database, a damaged one, or tables that are not ours */
        return FM_INVALID;
    }
}

fm_status sql_fail(const fm_history *history, int code, fm_error *err)
{
    const fm_status status = status_of(code);
    const char *message =
        history->sqlite != NULL ? sqlite3_errmsg(history->sqlite) : sqlite3_errstr(code);
    if (status != FM_INVALID)
        return fm_fail(err, status, "%s: %s", history->path, message);
    return fm_fail(err, status, "%s: damaged, or no history of fragmark: %s", history->path,
                   message);
}

fm_status sql_run(fm_history *history, const char *sql, fm_error *err)
{
    const int code = sqlite3_exec(history->sqlite, sql, NULL, NULL, NULL);
    return code == SQLITE_OK ? FM_OK : sql_fail(history, code, err);
}

fm_status sql_prepare(sqlite3_stmt **statement, fm_history *history, const char *sql, fm_error *err)
{
    const int code = sqlite3_prepare_v2(history->sqlite, sql, -1, statement, NULL);
    return code == SQLITE_OK ? FM_OK : sql_fail(history, code, err);
}

fm_status sql_step(bool *has_row, fm_history *history, sqlite3_stmt *statement, fm_error *err)
{
    const int code = sqlite3_step(statement);
    *has_row = code == SQLITE_ROW;
    return code == SQLITE_ROW || code == SQLITE_DONE ? FM_OK : sql_fail(history, code, err);
}

fm_status sql_finish(fm_history *history, sqlite3_stmt *statement, fm_error *err)
{
    bool has_row;
    const fm_status status = sql_step(&has_row, history, statement, err);
    sqlite3_reset(statement);
    sqlite3_clear_bindings(statement);
    return status;
}

fm_status sql_number(sqlite3_int64 *number, fm_history *history, const char *sql, fm_error *err)
{
    sqlite3_stmt *statement = NULL;
    bool has_row = false;
    fm_status status = sql_prepare(&statement, history, sql, err);
    if (status == FM_OK)
        status = sql_step(&has_row, history, statement, err);
    *number = has_row ? sqlite3_column_int64(statement, 0) : 0;
    sqlite3_finalize(statement);
    return status;
}

static int place(sqlite3_stmt *statement, const char *name)
{
    const int index = sqlite3_bind_parameter_index(statement, name);
    assert(index > 0);
    return index;
}

/* A text that does not fit into memory becomes NULL, which columns that need one refuse. */
void sql_bind_text(sqlite3_stmt *statement, const char *name, const char *text)
{
    sqlite3_bind_text(statement, place(statement, name), text, -1, SQLITE_TRANSIENT);
}

void sql_bind_real(sqlite3_stmt *statement, const char *name, double value)
{
    sqlite3_bind_double(statement, place(statement, name), value); /* NAN is stored as NULL */
}

void sql_bind_whole(sqlite3_stmt *statement, const char *name, sqlite3_int64 value)
{
    sqlite3_bind_int64(statement, place(statement, name), value);
}

const char *sql_text(sqlite3_stmt *statement, int column)
{
    const unsigned char *found = sqlite3_column_text(statement, column);
    fm_text text = { 0 };
    text_add(&text, "%s", found != NULL ? (const char *)found : "");
    if (text.bytes == NULL)
        return "";
    text_make_utf8(text.bytes);
    const char *shared = text_shared(text.bytes);
    text_free(&text);
    return shared != NULL ? shared : "";
}

double sql_real(sqlite3_stmt *statement, int column)
{
    const int type = sqlite3_column_type(statement, column);
    return type == SQLITE_FLOAT || type == SQLITE_INTEGER ? sqlite3_column_double(statement, column)
                                                          : NAN;
}

fm_status sql_begin(fm_history *history, fm_error *err)
{
    return sql_run(history, "BEGIN IMMEDIATE", err);
}

fm_status sql_end(fm_history *history, fm_status status, fm_error *err)
{
    if (status == FM_OK)
        status = sql_run(history, "COMMIT", err);
    if (status != FM_OK)
        sqlite3_exec(history->sqlite, "ROLLBACK", NULL, NULL, NULL);
    return status;
}
