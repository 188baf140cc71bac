#include "database.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/file.h"
#include "sql.h"

/* Numbers are NULL where a case has none. Names of columns are those of summary.csv. */
static const char *const migrations[HISTORY_VERSION] = {
    /* 1: machines, runs, their cases, and the launches of these. */
    "CREATE TABLE machine(id INTEGER PRIMARY KEY, fingerprint TEXT NOT NULL UNIQUE,"
    " cpu TEXT NOT NULL, cores TEXT NOT NULL, memory_bytes REAL NOT NULL);"
    "CREATE TABLE run(id INTEGER PRIMARY KEY, run_id TEXT NOT NULL UNIQUE, started TEXT NOT NULL,"
    " git_commit TEXT NOT NULL, version TEXT NOT NULL, command TEXT NOT NULL,"
    " directory TEXT NOT NULL, machine INTEGER NOT NULL REFERENCES machine(id));"
    "CREATE TABLE measured(id INTEGER PRIMARY KEY,"
    " run INTEGER NOT NULL REFERENCES run(id) ON DELETE CASCADE,"
    " case_id TEXT NOT NULL, name TEXT NOT NULL, title TEXT NOT NULL, workload TEXT NOT NULL,"
    " method TEXT NOT NULL, method_version TEXT NOT NULL, options TEXT NOT NULL,"
    " scene TEXT NOT NULL, device TEXT NOT NULL, device_name TEXT NOT NULL, feed TEXT NOT NULL,"
    " k REAL, n REAL, is_reference INTEGER NOT NULL, status TEXT NOT NULL, noisy TEXT NOT NULL,"
    " code_program TEXT NOT NULL, code_driver TEXT NOT NULL, code_plugin TEXT NOT NULL,"
    " code_shaders TEXT NOT NULL, image TEXT NOT NULL,"
    " frame_ms REAL, frame_ms_low REAL, frame_ms_high REAL,"
    " floor_ratio REAL, floor_ratio_low REAL, floor_ratio_high REAL,"
    " bytes_allocated REAL, bytes_used REAL, missing REAL, extra REAL, misordered REAL,"
    " max_abs REAL, rmse REAL, total_rmse REAL, flip REAL, UNIQUE(run, case_id));"
    "CREATE TABLE launch(measured INTEGER NOT NULL REFERENCES measured(id) ON DELETE CASCADE,"
    " launch INTEGER NOT NULL, frame_ms REAL, floor_frame_ms REAL,"
    " PRIMARY KEY(measured, launch)) WITHOUT ROWID;",
    /* 2: a case is found in all nights without reading them. */
    "CREATE INDEX measured_by_name ON measured(name, device_name, run);",
};

const char *history_migration(int version)
{
    return migrations[version - 1];
}

/* Whether there is a file, which is one. */
static fm_status look(bool *is_there, const char *path, fm_error *err)
{
    int fd = -1;
    uint64_t size_bytes = 0;
    *is_there = false;
    if (access(path, F_OK) != 0 && errno == ENOENT)
        return FM_OK;
    const fm_status status = file_open(&fd, &size_bytes, path, err);
    if (status != FM_OK)
        return status;
    close(fd);
    *is_there = size_bytes > 0; /* a first writer may have got no further */
    return FM_OK;
}

/* One of another program stays as it is. */
static fm_status check_owner(fm_history *history, fm_error *err)
{
    sqlite3_int64 application = 0, tables = 0, version = 0;
    fm_status status = sql_number(&application, history, "PRAGMA application_id", err);
    if (status == FM_OK)
        status = sql_number(&tables, history, "SELECT count(*) FROM sqlite_schema", err);
    if (status == FM_OK)
        status = sql_number(&version, history, "PRAGMA user_version", err);
    if (status != FM_OK || (application == 0 && tables == 0 && version == 0))
        return status;
    if (application != HISTORY_APPLICATION)
        return fm_fail(err, FM_INVALID, "%s: a database of another program, no history of fragmark",
                       history->path);
    if (version < 1 || version > HISTORY_VERSION)
        return fm_fail(err, FM_INVALID,
                       "%s: version %lld of a history; this fragmark knows up to %d: take the "
                       "fragmark that wrote it",
                       history->path, (long long)version, HISTORY_VERSION);
    return FM_OK;
}

static fm_status check_pages(fm_history *history, fm_error *err)
{
    sqlite3_stmt *statement = NULL;
    bool has_row = false;
    fm_status status = sql_prepare(&statement, history, "PRAGMA quick_check(1)", err);
    if (status == FM_OK)
        status = sql_step(&has_row, history, statement, err);
    if (status == FM_OK && has_row) {
        const char *answer = sql_text(statement, 0);
        if (strcmp(answer, "ok") != 0)
            status = fm_fail(err, FM_INVALID, "%s: damaged: %s", history->path, answer);
    }
    sqlite3_finalize(statement);
    return status;
}

/* Asked again once nobody else can change it: another process may just have done it. */
static fm_status migrate(fm_history *history, fm_error *err)
{
    char pragma[96];
    sqlite3_int64 version = 0;
    fm_status status = sql_number(&version, history, "PRAGMA user_version", err);
    if (status != FM_OK || version == HISTORY_VERSION)
        return status;
    status = sql_begin(history, err);
    if (status != FM_OK)
        return status;
    status = check_owner(history, err);
    if (status == FM_OK)
        status = sql_number(&version, history, "PRAGMA user_version", err);
    for (int i = (int)version; i < HISTORY_VERSION && status == FM_OK; i++)
        status = sql_run(history, migrations[i], err);
    snprintf(pragma, sizeof pragma, "PRAGMA application_id=%d; PRAGMA user_version=%d;",
             HISTORY_APPLICATION, HISTORY_VERSION);
    if (status == FM_OK)
        status = sql_run(history, pragma, err);
    return sql_end(history, status, err);
}

static fm_status connect(fm_history *history, fm_history_use use, fm_error *err)
{
    const int flags = SQLITE_OPEN_READWRITE | (use == FM_HISTORY_WRITE ? SQLITE_OPEN_CREATE : 0);
    const int code = sqlite3_open_v2(history->path, &history->sqlite, flags, NULL);
    if (code != SQLITE_OK)
        return sql_fail(history, code, err);
    sqlite3_busy_timeout(history->sqlite, HISTORY_WAIT_MS);
    sqlite3_db_config(history->sqlite, SQLITE_DBCONFIG_DEFENSIVE, 1, NULL);
    fm_status status = check_owner(history, err);
    if (status == FM_OK)
        status = check_pages(history, err);
    if (status == FM_OK)
        status = migrate(history, err);
    return status == FM_OK ? sql_run(history, "PRAGMA foreign_keys=ON", err) : status;
}

fm_status history_open(fm_history **history, const char *path, fm_history_use use, fm_error *err)
{
    bool is_there;
    *history = NULL;
    fm_status status = look(&is_there, path, err);
    if (status != FM_OK)
        return status;
    if (!is_there && use == FM_HISTORY_READ)
        return fm_fail(err, FM_UNSUPPORTED,
                       "%s: there is no history yet; `fragmark history add DIR` begins one", path);
    fm_history *opened = calloc(1, sizeof *opened);
    if (opened == NULL)
        return fm_fail(err, FM_NO_MEMORY, "%s: no memory", path);
    opened->path = path;
    status = connect(opened, use, err);
    if (status == FM_OK)
        *history = opened;
    else
        history_close(opened);
    return status;
}

void history_close(fm_history *history)
{
    if (history == NULL)
        return;
    sqlite3_close(history->sqlite);
    free(history);
}
