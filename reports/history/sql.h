/* Statements of the room, with errors that name the file. */
#ifndef FM_HISTORY_SQL_H
#define FM_HISTORY_SQL_H

#include <sqlite3.h>
#include <stdbool.h>

#include "database.h"

struct fm_history {
    sqlite3 *sqlite;
    const char *path; /* borrowed */
};

/* What SQLite said last, as an error of ours (database.h). */
fm_status sql_fail(const fm_history *history, int code, fm_error *err);
/* Statements without results. */
fm_status sql_run(fm_history *history, const char *sql, fm_error *err);
/* The whole number that the first column of the first row is. */
fm_status sql_number(sqlite3_int64 *number, fm_history *history, const char *sql, fm_error *err);
/* The caller finalises it; NULL on failure. */
fm_status sql_prepare(sqlite3_stmt **statement, fm_history *history, const char *sql,
                      fm_error *err);
/* The next row; *has_row false: that was all. */
fm_status sql_step(bool *has_row, fm_history *history, sqlite3_stmt *statement, fm_error *err);
/* Of statements without rows: done, and ready to be bound again. */
fm_status sql_finish(fm_history *history, sqlite3_stmt *statement, fm_error *err);

/* By the name of a parameter, ":name", which is there. Texts are copied; NAN becomes NULL. */
void sql_bind_text(sqlite3_stmt *statement, const char *name, const char *text);
void sql_bind_real(sqlite3_stmt *statement, const char *name, double value);
void sql_bind_whole(sqlite3_stmt *statement, const char *name, sqlite3_int64 value);
/* NULL is "" and NAN. Texts are UTF-8, and are shared (base/text.h): they stay; "" also if there is
 * no memory. */
const char *sql_text(sqlite3_stmt *statement, int column);
double sql_real(sqlite3_stmt *statement, int column);

/* A change that is made as a whole, and is alone while it is made. */
fm_status sql_begin(fm_history *history, fm_error *err);
/* Keeps the change if `status` is FM_OK, else drops it; returns what became of it. */
fm_status sql_end(fm_history *history, fm_status status, fm_error *err);

#endif
