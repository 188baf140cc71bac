#include "runs.h"

#include <jansson.h>
#include <stdlib.h>

#include "sql.h"

static const char select_runs[] =
    "SELECT run_id, started, git_commit, version, command, directory, fingerprint, cpu, cores,"
    " memory_bytes, (SELECT count(*) FROM measured WHERE run = run.id),"
    " (SELECT count(*) FROM measured WHERE run = run.id AND status = 'ok'),"
    " (SELECT count(*) FROM measured WHERE run = run.id"
    "  AND status NOT IN ('ok', 'not_supported', 'skipped'))"
    " FROM run JOIN machine ON machine.id = run.machine ORDER BY started DESC, run.id DESC";

static fm_run_entry read_run(sqlite3_stmt *from)
{
    return (fm_run_entry){
        .run_id = sql_text(from, 0),
        .started = sql_text(from, 1),
        .git_commit = sql_text(from, 2),
        .version = sql_text(from, 3),
        .command = sql_text(from, 4),
        .directory = sql_text(from, 5),
        .machine = sql_text(from, 6),
        .cpu = sql_text(from, 7),
        .cores = sql_text(from, 8),
        .memory_bytes = sql_real(from, 9),
        .cases = (size_t)sqlite3_column_int64(from, 10),
        .ok = (size_t)sqlite3_column_int64(from, 11),
        .failed = (size_t)sqlite3_column_int64(from, 12),
    };
}

static fm_status add_run(fm_run_list *runs, sqlite3_stmt *from, fm_error *err)
{
    fm_run_entry *grown = realloc(runs->items, (runs->count + 1) * sizeof *grown);
    if (grown == NULL)
        return fm_fail(err, FM_NO_MEMORY, "no memory for %zu runs", runs->count + 1);
    runs->items = grown;
    runs->items[runs->count++] = read_run(from);
    return FM_OK;
}

fm_status history_runs(fm_run_list *runs, fm_history *history, fm_error *err)
{
    sqlite3_stmt *statement = NULL;
    bool has_row = true;
    *runs = (fm_run_list){ 0 };
    fm_status status = sql_prepare(&statement, history, select_runs, err);
    while (status == FM_OK && has_row) {
        status = sql_step(&has_row, history, statement, err);
        if (status == FM_OK && has_row)
            status = add_run(runs, statement, err);
    }
    sqlite3_finalize(statement);
    return status;
}

void history_runs_free(fm_run_list *runs)
{
    free(runs->items);
    *runs = (fm_run_list){ 0 };
}

static const char select_newer[] =
    "SELECT count(*), max(later.started) FROM run this JOIN run later"
    " ON later.machine = this.machine AND later.started > this.started"
    " WHERE this.run_id = :run_id AND EXISTS(SELECT 1 FROM measured m JOIN measured n"
    "  ON n.name = m.name AND n.run = later.id WHERE m.run = this.id)";

fm_status history_newer_runs(fm_newer_runs *newer, fm_history *history, const char *run_id,
                             fm_error *err)
{
    sqlite3_stmt *statement = NULL;
    bool has_row;
    *newer = (fm_newer_runs){ .last = "" };
    fm_status status = sql_prepare(&statement, history, select_newer, err);
    if (status != FM_OK)
        return status;
    sql_bind_text(statement, ":run_id", run_id);
    status = sql_step(&has_row, history, statement, err);
    if (status == FM_OK && has_row)
        *newer =
            (fm_newer_runs){ (size_t)sqlite3_column_int64(statement, 0), sql_text(statement, 1) };
    sqlite3_finalize(statement);
    return status;
}

void history_add_runs(fm_text *text, const fm_run_list *runs)
{
    if (runs->count == 0)
        text_add(text, "no run yet; `fragmark history add DIR` adds one\n");
    else
        text_add(text, "%-20s  %-10s  %-8s  %5s  %5s  %6s  %s\n", "started", "commit", "machine",
                 "cases", "ok", "failed", "folder");
    for (size_t i = 0; i < runs->count; i++) {
        const fm_run_entry *run = &runs->items[i];
        text_add(text, "%-20s  %-10.10s  %-8s  %5zu  %5zu  %6zu  %s\n", run->started,
                 run->git_commit, run->machine, run->cases, run->ok, run->failed, run->directory);
    }
}

static json_t *run_json(const fm_run_entry *run)
{
    return json_pack("{s:s, s:s, s:s, s:s, s:s, s:s, s:{s:s, s:s, s:s, s:f}, s:I, s:I, s:I}",
                     "run_id", run->run_id, "started", run->started, "git_commit", run->git_commit,
                     "fragmark", run->version, "command", run->command, "directory", run->directory,
                     "machine", "fingerprint", run->machine, "cpu", run->cpu, "cores", run->cores,
                     "memory_bytes", run->memory_bytes, "cases", (json_int_t)run->cases, "ok",
                     (json_int_t)run->ok, "failed", (json_int_t)run->failed);
}

fm_status history_add_runs_json(fm_text *json, const fm_run_list *runs, fm_error *err)
{
    json_t *list = json_array();
    int failed = list == NULL;
    for (size_t i = 0; i < runs->count && !failed; i++)
        failed = json_array_append_new(list, run_json(&runs->items[i]));
    char *text = failed ? NULL : json_dumps(list, JSON_INDENT(2));
    if (text != NULL)
        text_add(json, "%s\n", text);
    json_decref(list);
    const bool is_made = text != NULL && !json->failed;
    free(text);
    return is_made ? FM_OK
                   : fm_fail(err, FM_NO_MEMORY, "no memory for JSON of %zu runs", runs->count);
}
