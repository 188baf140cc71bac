#include "record.h"

#include <stdlib.h>
#include <string.h>

#include "compare/comparison.h"
#include "compare/launches.h"
#include "read/options.h"
#include "read/workload.h"
#include "sql.h"

/* A run that is being recorded. */
typedef struct recorder {
    fm_history *history;
    const fm_result_files *results;
    fm_images images;
    sqlite3_int64 run;
    sqlite3_stmt *measured, *launch;
    fm_error *err;
} recorder;

/* Numbers that are columns of their own. */
static const struct {
    const char *name;
    fm_metric metric;
} numbers[] = {
    { ":bytes_allocated", FM_METRIC_BYTES_ALLOCATED },
    { ":bytes_used", FM_METRIC_BYTES_USED },
    { ":missing", FM_METRIC_MISSING },
    { ":extra", FM_METRIC_EXTRA },
    { ":misordered", FM_METRIC_MISORDERED },
    { ":max_abs", FM_METRIC_MAX_ABS },
    { ":rmse", FM_METRIC_RMSE },
    { ":total_rmse", FM_METRIC_TOTAL_RMSE },
    { ":flip", FM_METRIC_FLIP },
    { ":n", FM_METRIC_N },
};

static const char insert_measured[] =
    "INSERT INTO measured(run, case_id, name, title, workload, method, method_version, options,"
    " scene, device, device_name, feed, k, n, is_reference, status, noisy, code_program,"
    " code_driver, code_plugin, code_shaders, image, frame_ms, frame_ms_low, frame_ms_high,"
    " floor_ratio, floor_ratio_low, floor_ratio_high, bytes_allocated, bytes_used, missing, extra,"
    " misordered, max_abs, rmse, total_rmse, flip) VALUES(:run, :case_id, :name, :title, :workload,"
    " :method, :method_version, :options, :scene, :device, :device_name, :feed, :k, :n,"
    " :is_reference, :status, :noisy, :code_program, :code_driver, :code_plugin, :code_shaders,"
    " :image, :frame_ms, :frame_ms_low, :frame_ms_high, :floor_ratio, :floor_ratio_low,"
    " :floor_ratio_high, :bytes_allocated, :bytes_used, :missing, :extra, :misordered, :max_abs,"
    " :rmse, :total_rmse, :flip)";

static void bind_texts(sqlite3_stmt *to, const fm_case_row *row)
{
    const char *const texts[][2] = {
        { ":case_id", row->id },
        { ":method", row->method },
        { ":method_version", row->method_version },
        { ":options", row->options },
        { ":scene", row->scene },
        { ":device", row->device },
        { ":device_name", row->device_name },
        { ":feed", row->feed },
        { ":status", row->status },
        { ":noisy", row->noisy },
        { ":code_program", row->code_program },
        { ":code_driver", row->code_driver },
        { ":code_plugin", row->code_plugin },
        { ":code_shaders", row->code_shaders },
    };
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++)
        sql_bind_text(to, texts[i][0], texts[i][1]);
}

static fm_status bind_names(sqlite3_stmt *to, const fm_case_row *row, fm_error *err)
{
    char title[FM_COMPARED_NAME_BYTES], workload[WORKLOAD_KEY_BYTES];
    char options[FM_OPTIONS_TEXT_BYTES];
    fm_text name = { 0 }, full = { 0 };
    compared_name(title, row);
    workload_key(workload, row, NULL);
    options_select(options, row->options, FM_OPTIONS_OF_SCENE, NULL);
    text_add(&full, "%s|%s", workload, options);
    join_add_name(&name, row);
    const bool has_memory = !name.failed && !full.failed;
    if (has_memory) {
        sql_bind_text(to, ":title", title);
        sql_bind_text(to, ":name", name.bytes);
        sql_bind_text(to, ":workload", full.bytes);
    }
    text_free(&full);
    text_free(&name);
    return has_memory ? FM_OK : fm_fail(err, FM_NO_MEMORY, "no memory for a case's name");
}

static void bind_interval(sqlite3_stmt *to, const char *const names[3], const fm_interval *interval)
{
    sql_bind_real(to, names[0], interval->median);
    sql_bind_real(to, names[1], interval->low);
    sql_bind_real(to, names[2], interval->high);
}

static void bind_numbers(sqlite3_stmt *to, const fm_result_files *results, const fm_case_row *row)
{
    static const char *const frame[] = { ":frame_ms", ":frame_ms_low", ":frame_ms_high" };
    static const char *const floor[] = { ":floor_ratio", ":floor_ratio_low", ":floor_ratio_high" };
    const fm_interval frame_ms = { row->metric[FM_METRIC_FRAME_MS], row->low[FM_METRIC_FRAME_MS],
                                   row->high[FM_METRIC_FRAME_MS] };
    const fm_interval ratio = launches_ratio(results, row, "frame_ms", "floor_frame_ms");
    bind_interval(to, frame, &frame_ms);
    bind_interval(to, floor, &ratio);
    for (size_t i = 0; i < sizeof numbers / sizeof numbers[0]; i++)
        sql_bind_real(to, numbers[i].name, row->metric[numbers[i].metric]);
    sql_bind_real(to, ":k", row->k);
    sql_bind_whole(to, ":is_reference", quantity_is_reference(row));
}

static fm_status record_launches(recorder *to, const fm_case_row *row)
{
    fm_launch_list list;
    const sqlite3_int64 measured = sqlite3_last_insert_rowid(to->history->sqlite);
    fm_status status =
        launches_numbers(&list, to->results, row, "frame_ms", "floor_frame_ms", to->err);
    for (size_t i = 0; i < list.count && status == FM_OK; i++) {
        sql_bind_whole(to->launch, ":measured", measured);
        sql_bind_whole(to->launch, ":launch", list.items[i].launch);
        sql_bind_real(to->launch, ":frame_ms", list.items[i].value);
        sql_bind_real(to->launch, ":floor_frame_ms", list.items[i].over);
        status = sql_finish(to->history, to->launch, to->err);
    }
    free(list.items);
    return status;
}

static fm_status record_case(recorder *to, size_t index)
{
    const fm_case_row *row = &to->results->cases[index];
    fm_status status = bind_names(to->measured, row, to->err);
    if (status != FM_OK)
        return status;
    bind_texts(to->measured, row);
    bind_numbers(to->measured, to->results, row);
    sql_bind_whole(to->measured, ":run", to->run);
    sql_bind_text(to->measured, ":image", to->images.hashes[index]);
    status = sql_finish(to->history, to->measured, to->err);
    return status == FM_OK && row->is_measured && !row->is_simulated ? record_launches(to, row)
                                                                     : status;
}

static fm_status record_cases(recorder *to)
{
    fm_status status = sql_prepare(&to->measured, to->history, insert_measured, to->err);
    if (status == FM_OK)
        status = sql_prepare(&to->launch, to->history,
                             "INSERT INTO launch(measured, launch, frame_ms, floor_frame_ms)"
                             " VALUES(:measured, :launch, :frame_ms, :floor_frame_ms)",
                             to->err);
    for (size_t i = 0; i < to->results->count && status == FM_OK; i++)
        status = record_case(to, i);
    sqlite3_finalize(to->launch);
    sqlite3_finalize(to->measured);
    return status;
}

/* The first machine of the history that is the same; 0: none. */
static fm_status find_machine(sqlite3_int64 *machine, fm_history *history,
                              const fm_hardware *hardware, fm_error *err)
{
    sqlite3_stmt *statement = NULL;
    bool has_row = true;
    *machine = 0;
    fm_status status = sql_prepare(
        &statement, history, "SELECT id, cpu, cores, memory_bytes FROM machine ORDER BY id", err);
    while (status == FM_OK && has_row && *machine == 0) {
        status = sql_step(&has_row, history, statement, err);
        if (status != FM_OK || !has_row)
            break;
        const fm_hardware known = { sql_text(statement, 1), sql_text(statement, 2),
                                    sql_real(statement, 3) };
        if (hardware_is_same(&known, hardware))
            *machine = sqlite3_column_int64(statement, 0);
    }
    sqlite3_finalize(statement);
    return status;
}

/* Its fingerprint is of what it was like when it was seen first. */
static fm_status add_machine(sqlite3_int64 *machine, fm_history *history,
                             const fm_hardware *hardware, fm_error *err)
{
    char fingerprint[FM_FINGERPRINT_BYTES];
    sqlite3_stmt *statement = NULL;
    hardware_fingerprint(fingerprint, hardware);
    fm_status status = sql_prepare(&statement, history,
                                   "INSERT INTO machine(fingerprint, cpu, cores, memory_bytes)"
                                   " VALUES(:fingerprint, :cpu, :cores, :memory_bytes)",
                                   err);
    if (status != FM_OK)
        return status;
    sql_bind_text(statement, ":fingerprint", fingerprint);
    sql_bind_text(statement, ":cpu", hardware->cpu);
    sql_bind_text(statement, ":cores", hardware->cores);
    sql_bind_real(statement, ":memory_bytes", hardware->memory_bytes);
    status = sql_finish(history, statement, err);
    *machine = sqlite3_last_insert_rowid(history->sqlite);
    sqlite3_finalize(statement);
    return status;
}

static fm_status add_run(recorder *to, sqlite3_int64 machine)
{
    static const char *const facts[][2] = { { ":run_id", "run_id" },
                                            { ":started", "started" },
                                            { ":git_commit", "git_commit" },
                                            { ":version", "fragmark" },
                                            { ":command", "command" } };
    sqlite3_stmt *statement = NULL;
    fm_status status = sql_prepare(
        &statement, to->history,
        "INSERT INTO run(run_id, started, git_commit, version, command, directory, machine)"
        " VALUES(:run_id, :started, :git_commit, :version, :command, :directory, :machine)",
        to->err);
    if (status != FM_OK)
        return status;
    for (size_t i = 0; i < sizeof facts / sizeof facts[0]; i++)
        sql_bind_text(statement, facts[i][0], provenance_fact(to->results->manifest, facts[i][1]));
    sql_bind_text(statement, ":directory", to->results->directory);
    sql_bind_whole(statement, ":machine", machine);
    status = sql_finish(to->history, statement, to->err);
    to->run = sqlite3_last_insert_rowid(to->history->sqlite);
    sqlite3_finalize(statement);
    return status;
}

static fm_status forget_run(fm_recorded *recorded, recorder *to)
{
    sqlite3_stmt *statement = NULL;
    fm_status status =
        sql_prepare(&statement, to->history, "DELETE FROM run WHERE run_id = :run_id", to->err);
    if (status != FM_OK)
        return status;
    sql_bind_text(statement, ":run_id", provenance_fact(to->results->manifest, "run_id"));
    status = sql_finish(to->history, statement, to->err);
    *recorded = sqlite3_changes(to->history->sqlite) > 0 ? FM_RECORDED_REPLACED : FM_RECORDED_NEW;
    sqlite3_finalize(statement);
    return status;
}

static fm_status record_run(fm_recorded *recorded, recorder *to)
{
    sqlite3_int64 machine = 0;
    const fm_hardware hardware = provenance_hardware(to->results->manifest);
    fm_status status = forget_run(recorded, to);
    if (status == FM_OK)
        status = find_machine(&machine, to->history, &hardware, to->err);
    if (status == FM_OK && machine == 0)
        status = add_machine(&machine, to->history, &hardware, to->err);
    if (status == FM_OK)
        status = add_run(to, machine);
    return status == FM_OK ? record_cases(to) : status;
}

static fm_status check_manifest(const fm_result_files *results, fm_error *err)
{
    static const char *const needed[] = { "run_id", "started" };
    const fm_hardware hardware = provenance_hardware(results->manifest);
    for (size_t i = 0; i < sizeof needed / sizeof needed[0]; i++)
        if (provenance_fact(results->manifest, needed[i])[0] == '\0')
            return fm_fail(err, FM_UNSUPPORTED,
                           "%s/manifest.json: no '%s': the run has no place in a history",
                           results->directory, needed[i]);
    return hardware_is_known(&hardware)
               ? FM_OK
               : fm_fail(err, FM_UNSUPPORTED,
                         "%s/manifest.json: cpu, cores or memory_bytes is not told: which machine "
                         "measured is not known",
                         results->directory);
}

fm_status history_record(fm_recorded *recorded, fm_history *history, const fm_result_files *results,
                         fm_error *err)
{
    recorder to = { .history = history, .results = results, .err = err };
    fm_status status = check_manifest(results, err);
    if (status == FM_OK)
        status = images_read(&to.images, results, err);
    if (status == FM_OK)
        status = sql_begin(history, err);
    if (status == FM_OK)
        status = sql_end(history, record_run(recorded, &to), err);
    images_free(&to.images);
    return status;
}
