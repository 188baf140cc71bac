#include "run.h"

#include <assert.h>
#include <dirent.h>
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>
#include <xxhash.h>

#include "base/random.h"
#include "journal.h"
#include "launch.h"
#include "manifest.h"
#include "progress.h"
#include "results.h"
#include "truth_jobs.h"
#include "worker/protocol.h"

enum { TIMEOUT_DEFAULT_S = 600 };

typedef struct run_state {
    const fm_plan *plan;
    const fm_plugin_list *plugins;
    const fm_run_desc *desc;
    fm_journal *journal;
    fm_results *results;
    fm_truth_jobs truths;
    fm_launcher launcher;
    fm_progress progress;
    uint32_t *order; /* [plan->count]: of the running round */
    int stop_signal;
    bool is_damaged;
} run_state;

static fm_status path_of(char path[FM_PATH_MAX_BYTES], const run_state *run, const char *folder,
                         const char *name, const char *ending, fm_error *err)
{
    char inside[FM_PATH_MAX_BYTES];
    snprintf(inside, sizeof inside, "%s%s%s%s", folder, name[0] != '\0' ? "/" : "", name, ending);
    return path_join(path, run->desc->directory, inside, err);
}

/* Like mkdir -p. */
static fm_status make_folder(const char *path, fm_error *err)
{
    char part[FM_PATH_MAX_BYTES];
    struct stat info;
    snprintf(part, sizeof part, "%s", path);
    for (char *slash = strchr(part + 1, '/'); slash != NULL; slash = strchr(slash + 1, '/')) {
        *slash = '\0';
        (void)mkdir(part, 0777); /* the last one tells */
        *slash = '/';
    }
    if (mkdir(part, 0777) == 0 ||
        (errno == EEXIST && stat(part, &info) == 0 && S_ISDIR(info.st_mode)))
        return FM_OK;
    return fm_fail(err, FM_INVALID, "%s: cannot be made: %s", path, strerror(errno));
}

static fm_status make_folders(const run_state *run, fm_error *err)
{
    static const char *const folders[] = { "work", "truth", "images" };
    char path[FM_PATH_MAX_BYTES], journal[FM_PATH_MAX_BYTES];
    fm_status status = path_of(journal, run, "journal.jsonl", "", "", err);
    if (status == FM_OK)
        status = path_of(path, run, "summary.csv", "", "", err);
    if (status == FM_OK && access(journal, F_OK) != 0 && access(path, F_OK) == 0)
        status = fm_fail(err, FM_INVALID,
                         "%s holds results that no journal belongs to: choose another -o",
                         run->desc->directory);
    for (size_t i = 0; i < sizeof folders / sizeof folders[0] && status == FM_OK; i++) {
        if (run->desc->no_images && strcmp(folders[i], "images") == 0)
            continue;
        status = path_of(path, run, folders[i], "", "", err);
        if (status == FM_OK)
            status = make_folder(path, err);
    }
    return status;
}

/* What makes two runs the same run: what they measure, how often, and in which order. */
static void plan_hash(char hash[17], const fm_plan *plan, const fm_run_desc *desc)
{
    XXH3_state_t *state = XXH3_createState();
    const uint64_t numbers[] = { plan->seed,   plan->launches,   plan->frames,
                                 plan->warmup, desc->validation, desc->no_timers };
    hash[0] = '\0';
    if (state == NULL)
        return;
    XXH3_64bits_reset(state);
    XXH3_64bits_update(state, numbers, sizeof numbers);
    for (size_t i = 0; i < plan->count; i++)
        XXH3_64bits_update(state, plan->cases[i].id, strlen(plan->cases[i].id) + 1);
    snprintf(hash, 17, "%016llx", (unsigned long long)XXH3_64bits_digest(state));
    XXH3_freeState(state);
}

static fm_status replay(void *context, fm_journal_event event, const char *case_id, uint32_t launch,
                        const json_t *result, fm_error *err)
{
    run_state *run = context;
    size_t i = 0;
    while (i < run->plan->count && strcmp(run->plan->cases[i].id, case_id) != 0)
        i++;
    if (i == run->plan->count || launch >= plan_case_launches(run->plan, i))
        return fm_fail(err, FM_INVALID, "case %.32s, launch %u is not of this plan", case_id,
                       launch);
    fm_launch_state *state = &run->results->cases[i].launches[launch];
    switch (event) {
    case FM_JOURNAL_BEGIN:
        state->begins++;
        return FM_OK;
    case FM_JOURNAL_STOP:
        state->begins = 0;
        return FM_OK;
    case FM_JOURNAL_END:
        return state->is_done ? fm_fail(err, FM_INVALID, "launch %u ended twice", launch)
                              : results_add(run->results, i, launch, result, err);
    case FM_JOURNAL_EVENT_COUNT:
        break;
    }
    return fm_fail(err, FM_INVALID, "unknown event");
}

static fm_status end_launch(run_state *run, size_t case_index, uint32_t launch, json_t *result,
                            fm_error *err)
{
    const char *id = run->plan->cases[case_index].id;
    fm_status status = journal_write(run->journal, FM_JOURNAL_END, id, launch, result, err);
    if (status == FM_OK)
        status = results_add(run->results, case_index, launch, result, err);
    if (status == FM_OK && results_is_finished(run->results, case_index))
        status = results_write_summary(run->results, err);
    return status;
}

/* A launch that took the whole run down twice is not tried a third time. */
static fm_status bury_killers(run_state *run, fm_error *err)
{
    fm_status status = FM_OK;
    for (size_t i = 0; i < run->plan->count && status == FM_OK; i++) {
        for (uint32_t launch = 0; launch < plan_case_launches(run->plan, i) && status == FM_OK;
             launch++) {
            const fm_launch_state *state = &run->results->cases[i].launches[launch];
            if (state->is_done || state->begins < 2)
                continue;
            json_t *result = answer_make(FM_CASE_CRASH,
                                         "began twice and never ended: the whole run died with it");
            status = end_launch(run, i, launch, result, err);
            json_decref(result);
        }
    }
    return status;
}

static fm_status resume(run_state *run, fm_error *err)
{
    char hash[17];
    const fm_journal_reader reader = { .line = replay, .context = run };
    plan_hash(hash, run->plan, run->desc);
    fm_status status =
        journal_open(&run->journal, run->desc->directory, hash, &run->is_damaged, err);
    if (status == FM_OK)
        status = results_create(&run->results, run->plan, run->plugins, run->desc->directory,
                                journal_run_id(run->journal), err);
    if (status == FM_OK)
        status = journal_replay(run->journal, &reader, &run->is_damaged, err);
    if (status == FM_OK)
        status = bury_killers(run, err);
    return status;
}

static void tick(void *context)
{
    progress_tick(context);
}

/* Writes the request, launches, and cleans up after what went well. */
static fm_status ask(fm_launch_outcome *outcome, run_state *run, const char *name,
                     const fm_request *request, fm_error *err)
{
    char request_path[FM_PATH_MAX_BYTES], result_path[FM_PATH_MAX_BYTES],
        log_path[FM_PATH_MAX_BYTES];
    struct stat log;
    *outcome = (fm_launch_outcome){ 0 };
    fm_status status = path_of(request_path, run, "work", name, ".request.json", err);
    if (status == FM_OK)
        status = path_of(result_path, run, "work", name, ".result.json", err);
    if (status == FM_OK)
        status = path_of(log_path, run, "work", name, ".log", err);
    if (status == FM_OK)
        status = request_write(request_path, request, err);
    if (status != FM_OK)
        return status;
    const fm_launch_desc desc = {
        .worker = run->desc->worker,
        .request = request_path,
        .result = result_path,
        .log = log_path,
        .timeout_s = run->desc->timeout_s != 0 ? run->desc->timeout_s : TIMEOUT_DEFAULT_S,
        .memory_bytes = run->desc->memory_bytes,
        .tick = tick,
        .context = &run->progress,
    };
    status = launch_worker(outcome, &run->launcher, &desc, err);
    if (status != FM_OK)
        return status;
    run->stop_signal = outcome->stop_signal;
    if (outcome->is_interrupted || answer_status(outcome->result) <= FM_CASE_WRONG_IMAGE) {
        unlink(request_path);
        unlink(result_path);
    }
    if (stat(log_path, &log) == 0 && log.st_size == 0)
        unlink(log_path);
    return FM_OK;
}

static bool is_pending(const run_state *run, size_t case_index)
{
    return run->plan->cases[case_index].skip[0] == '\0' &&
           !results_is_finished(run->results, case_index);
}

static bool should_stop(run_state *run)
{
    if (run->stop_signal == 0)
        run->stop_signal = launcher_stop_signal(&run->launcher);
    return run->stop_signal != 0;
}

/* All cases of a truth that cannot be had end as it did. */
static fm_status fail_truth(run_state *run, size_t job, const json_t *result, fm_error *err)
{
    fm_status status = FM_OK;
    char message[2048];
    snprintf(message, sizeof message, "no truth: %.2000s", answer_message(result));
    json_t *verdict = answer_make(answer_status(result), message);
    for (size_t i = 0; i < run->plan->count && status == FM_OK; i++) {
        if (run->truths.of_case[i] != job || !is_pending(run, i))
            continue;
        uint32_t launch = 0;
        while (run->results->cases[i].launches[launch].is_done)
            launch++;
        status = end_launch(run, i, launch, verdict, err);
    }
    json_decref(verdict);
    return status;
}

/* The run's own files failed: the launch stays unfinished, nobody gets a verdict, and the run
 * stops, to be continued when the fault is gone. */
static fm_status fail_run(const json_t *answer, const char *current, fm_error *err)
{
    return fm_fail(err, FM_IO, "%s: %s; the launch is not finished, and the same command continues",
                   current, answer_message(answer));
}

static const char *plugin_path(const run_state *run, const fm_case *of)
{
    const fm_plugin_entry *entry = plugin_list_find(run->plugins, of->method);
    return entry != NULL && entry->plugin != NULL ? entry->plugin->path : "";
}

static fm_status capture_truth(run_state *run, size_t job, fm_error *err)
{
    char path[FM_PATH_MAX_BYTES], name[sizeof run->truths.jobs[job].name + 8], current[160];
    const fm_case *of = &run->plan->cases[run->truths.jobs[job].of];
    fm_launch_outcome outcome;
    fm_status status = path_of(path, run, "truth", run->truths.jobs[job].name, ".truth", err);
    if (status != FM_OK)
        return status;
    snprintf(name, sizeof name, "truth-%s", run->truths.jobs[job].name);
    snprintf(current, sizeof current, "truth of %.60s on %.60s", of->scene, of->device);
    progress_begin(&run->progress, current);
    if (access(path, R_OK) == 0) { /* an interrupted run's: written whole or not at all */
        progress_skip(&run->progress);
        return FM_OK;
    }
    const fm_request request = {
        .device = of->device,
        .feed = of->feed,
        .settings = &of->settings,
        .choices = of->choices,
        .choice_count = of->choice_count,
        .plugin = plugin_path(run, of),
        .floor = run->truths.jobs[job].floor,
        .common = run->plugins->common_folder,
        .truth = path,
        .image = "",
        .is_truth_job = true,
        .validation = run->desc->validation,
        .no_timers = run->desc->no_timers,
    };
    status = ask(&outcome, run, name, &request, err);
    if (status != FM_OK || outcome.is_interrupted)
        return status;
    if (answer_is_runs_fault(outcome.result))
        status = fail_run(outcome.result, current, err);
    else if (answer_status(outcome.result) != FM_CASE_OK)
        status = fail_truth(run, job, outcome.result, err);
    progress_end(&run->progress, outcome.seconds);
    json_decref(outcome.result);
    return status;
}

static fm_status measure(run_state *run, size_t case_index, uint32_t launch, fm_error *err)
{
    const fm_case *of = &run->plan->cases[case_index];
    char truth[FM_PATH_MAX_BYTES], image[FM_PATH_MAX_BYTES] = "", k[FM_PATH_MAX_BYTES],
                                   current[160];
    fm_launch_outcome outcome;
    fm_status status = path_of(
        truth, run, "truth", run->truths.jobs[run->truths.of_case[case_index]].name, ".truth", err);
    if (status == FM_OK && launch == 0 && !run->desc->no_images && !of->no_image)
        status = path_of(image, run, "images", of->id, ".rgba32f", err);
    if (status == FM_OK)
        status = journal_write(run->journal, FM_JOURNAL_BEGIN, of->id, launch, NULL, err);
    if (status != FM_OK)
        return status;
    settings_text(k, &of->settings, key_find("k"));
    const bool has_k = of->settings.k != 0;
    snprintf(current, sizeof current, "%.32s%s%.8s %.30s %.30s %.20s, launch %u", of->method,
             has_k ? " k=" : "", has_k ? k : "", of->scene, of->device, of->feed, launch);
    progress_begin(&run->progress, current);
    const fm_request request = {
        .device = of->device,
        .feed = of->feed,
        .settings = &of->settings,
        .choices = of->choices,
        .choice_count = of->choice_count,
        .plugin = plugin_path(run, of),
        .floor = run->truths.jobs[run->truths.of_case[case_index]].floor,
        .common = run->plugins->common_folder,
        .truth = truth,
        .image = image,
        .check = launch == 0,
        .validation = run->desc->validation,
        .no_timers = run->desc->no_timers,
        .launch = launch,
    };
    status = ask(&outcome, run, of->id, &request, err);
    if (status != FM_OK)
        return status;
    const bool is_unfinished = outcome.is_interrupted || answer_is_runs_fault(outcome.result);
    if (is_unfinished)
        status = journal_write(run->journal, FM_JOURNAL_STOP, of->id, launch, NULL, err);
    else
        status = end_launch(run, case_index, launch, outcome.result, err);
    if (outcome.is_interrupted)
        return status;
    if (status == FM_OK && is_unfinished)
        status = fail_run(outcome.result, current, err);
    progress_end(&run->progress, outcome.seconds);
    json_decref(outcome.result);
    return status;
}

/* The same order for a round whatever was already done: it depends on the seed alone. */
static void shuffle(run_state *run, uint32_t round)
{
    uint64_t seed = run->plan->seed, state;
    for (uint32_t i = 0; i <= round; i++)
        state = random_next(&seed);
    for (uint32_t i = 0; i < run->plan->count; i++)
        run->order[i] = i;
    for (uint32_t i = (uint32_t)run->plan->count; i > 1; i--) {
        const uint32_t j = random_below(&state, i), kept = run->order[i - 1];
        run->order[i - 1] = run->order[j];
        run->order[j] = kept;
    }
}

static fm_status run_round(run_state *run, uint32_t launch, fm_error *err)
{
    fm_status status = FM_OK;
    shuffle(run, launch);
    for (size_t i = 0; i < run->plan->count && status == FM_OK && !should_stop(run); i++) {
        const size_t index = run->order[i];
        if (launch >= plan_case_launches(run->plan, index))
            continue;
        if (is_pending(run, index) && !run->results->cases[index].launches[launch].is_done)
            status = measure(run, index, launch, err);
        else if (run->plan->cases[index].skip[0] == '\0' &&
                 !run->results->cases[index].launches[launch].is_done)
            run->progress.done++; /* its case failed before */
    }
    return status;
}

static bool truth_is_wanted(const run_state *run, size_t job)
{
    for (size_t i = 0; i < run->plan->count; i++)
        if (run->truths.of_case[i] == job && is_pending(run, i))
            return true;
    return false;
}

static void count_launches(run_state *run)
{
    for (size_t i = 0; i < run->truths.count; i++)
        run->progress.total += truth_is_wanted(run, i);
    for (size_t i = 0; i < run->plan->count; i++) {
        if (run->plan->cases[i].skip[0] != '\0')
            continue;
        run->progress.total += plan_case_launches(run->plan, i);
        run->progress.done += run->results->cases[i].done;
    }
}

static fm_status run_launches(run_state *run, fm_error *err)
{
    fm_status status = FM_OK;
    count_launches(run);
    for (size_t i = 0; i < run->truths.count && status == FM_OK && !should_stop(run); i++)
        if (truth_is_wanted(run, i))
            status = capture_truth(run, i, err);
    for (uint32_t i = 0; i < run->plan->launches && status == FM_OK && !should_stop(run); i++)
        status = run_round(run, i, err);
    progress_close(&run->progress);
    return status;
}

static void count_outcomes(fm_run_result *result, const run_state *run)
{
    for (size_t i = 0; i < run->plan->count; i++) {
        if (is_pending(run, i))
            result->skipped++;
        else if (run->results->cases[i].status == FM_CASE_OK)
            result->ok++;
        else if (run->results->cases[i].status == FM_CASE_NOT_SUPPORTED)
            result->not_supported++;
        else
            result->failed++;
    }
    result->stop_signal = run->stop_signal;
}

/* What only running launches need. Folders that hold more stay. */
static void remove_truths(const run_state *run)
{
    static const char *const suffixes[] = { ".truth", ".truth.hull" };
    char path[FM_PATH_MAX_BYTES];
    for (size_t i = 0; i < 2 * run->truths.count; i++)
        if (path_of(path, run, "truth", run->truths.jobs[i / 2].name, suffixes[i % 2], NULL) ==
            FM_OK)
            unlink(path);
    if (path_of(path, run, "truth", "", "", NULL) == FM_OK)
        rmdir(path);
    if (path_of(path, run, "work", "", "", NULL) == FM_OK)
        rmdir(path);
}

static fm_status write_manifest(const run_state *run, bool is_ended, fm_error *err)
{
    const fm_manifest_desc desc = {
        .run = run->desc,
        .results = run->results,
        .started = journal_started(run->journal),
        .is_ended = is_ended,
    };
    return manifest_write(&desc, err);
}

static fm_status prepare(run_state *run, fm_error *err)
{
    fm_status status = truth_jobs_create(&run->truths, run->plan, run->plugins, err);
    if (status == FM_OK)
        status = make_folders(run, err);
    if (status == FM_OK)
        status = resume(run, err);
    if (status == FM_OK)
        status = write_manifest(run, false, err);
    if (status == FM_OK)
        status = results_write_summary(run->results, err);
    return status;
}

fm_status run_cases(fm_run_result *result, const fm_plan *plan, const fm_plugin_list *plugins,
                    const fm_run_desc *desc, fm_error *err)
{
    fm_status status;
    run_state run = { .plan = plan, .plugins = plugins, .desc = desc };
    assert(plan->launches > 0 && plan->count < UINT32_MAX);
    *result = (fm_run_result){ 0 };
    run.progress.out = desc->progress;
    run.progress.is_terminal = desc->progress != NULL && isatty(fileno(desc->progress));
    run.order = calloc(plan->count > 0 ? plan->count : 1, sizeof *run.order);
    if (run.order == NULL)
        return fm_fail(err, FM_NO_MEMORY, "no memory for %zu cases", plan->count);
    status = prepare(&run, err);
    if (status == FM_OK) {
        launcher_open(&run.launcher);
        status = run_launches(&run, err);
        launcher_close(&run.launcher);
    }
    if (status == FM_OK)
        status = results_end(run.results, err);
    if (status == FM_OK)
        status = write_manifest(&run, run.stop_signal == 0, err);
    if (status == FM_OK) {
        count_outcomes(result, &run);
        if (run.stop_signal == 0)
            remove_truths(&run);
    }
    result->is_damaged = run.is_damaged;
    journal_close(run.journal);
    results_destroy(run.results);
    truth_jobs_free(&run.truths);
    free(run.order);
    return status;
}
