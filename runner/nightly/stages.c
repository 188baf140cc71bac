#include "stages.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "child/child.h"

static const double least_s = 20; /* a night that is continued gets so long, however late it is */

static bool add_all(fm_text_list *argv, const char *option, const fm_text_list *values)
{
    bool is_added = true;
    for (size_t i = 0; i < values->count; i++)
        is_added = is_added && text_list_add(argv, option) && text_list_add(argv, values->items[i]);
    return is_added;
}

static bool add_two(fm_text_list *argv, const char *option, const char *value)
{
    return text_list_add(argv, option) && text_list_add(argv, value);
}

/* The same for the same night, whenever it is continued. */
static fm_status list_arguments(fm_text_list *argv, const fm_tonight *tonight, const char *run,
                                fm_error *err)
{
    char launches[32];
    const fm_policy *policy = tonight->policy;
    const fm_night_state *night = &tonight->night;
    snprintf(launches, sizeof launches, "launches=%u", night->launches);
    const bool is_made =
        text_list_add(argv, "fragmark") && text_list_add(argv, "run") &&
        (policy->spec[0] == '\0' || text_list_add(argv, policy->spec)) &&
        add_all(argv, "--plugin-dir", &policy->plugin_folders) &&
        add_all(argv, "--method", night->methods.count > 0 ? &night->methods : &policy->methods) &&
        add_all(argv, "--scene", &policy->scenes) && add_all(argv, "--device", &policy->devices) &&
        add_all(argv, "--feed", &policy->feeds) && add_all(argv, "-a", &policy->axes) &&
        add_two(argv, "-a", launches) && add_two(argv, "-o", run) &&
        text_list_add(argv, "--no-report");
    return is_made ? FM_OK : fm_fail(err, FM_NO_MEMORY, "no memory for arguments");
}

static fm_status launch(int *code, fm_tonight *tonight, const fm_text_list *argv, double seconds,
                        fm_error *err)
{
    char log[FM_PATH_MAX_BYTES];
    pid_t pid;
    fm_status status = path_join(log, tonight->night.folder, "run.log", err);
    const fm_child_desc desc = {
        .path = "/proc/self/exe", .argv = argv->items, .log = log, .kept_fd = tonight->lock
    };
    if (status == FM_OK)
        status = child_start(&pid, &desc, err);
    if (status == FM_OK)
        tonight->night.is_cut_off = !child_wait(code, pid, seconds, NULL);
    return status;
}

/* What the run ended with, as the night sees it. */
static void take_code(int *code, fm_tonight *tonight)
{
    fm_night_state *night = &tonight->night;
    const bool has_results = night_launches_ended(night) > 0; /* summary.csv is there before */
    if (night->is_cut_off)
        *code = has_results ? CLI_DONE : CLI_NOTHING;
    const bool is_measured =
        *code == CLI_DONE || *code == CLI_CLAIM_FAILS || *code == CLI_SOME_FAILED;
    if (is_measured && has_results)
        night->stage = FM_NIGHT_JUDGES;
    /* A continued run that is refused is of another plan: its spec or the methods have changed. */
    if (*code == CLI_OTHER_CODE || (*code == CLI_USAGE && tonight->is_continued))
        night->stage = FM_NIGHT_GIVEN_UP;
}

fm_status stage_measure(int *code, fm_tonight *tonight, fm_error *err)
{
    char run[FM_PATH_MAX_BYTES];
    fm_text_list argv = { 0 };
    fm_night_state *night = &tonight->night;
    night->measured_s = night_measured_s(night);
    night->attempt_s = (int64_t)time(NULL);
    const double budget_s = 0.9 * 60.0 * tonight->policy->budget_minutes;
    const double left_s = budget_s - night->measured_s;
    const double seconds = tonight->is_continued ? fmax(left_s, least_s) : left_s;
    fm_status status = path_join(run, night->folder, "run", err);
    if (status == FM_OK)
        status = list_arguments(&argv, tonight, run, err);
    if (status == FM_OK)
        status = night_state_write(night, err);
    if (status == FM_OK)
        status = launch(code, tonight, &argv, seconds, err);
    text_list_free(&argv);
    if (status != FM_OK)
        return status;
    night->measured_s += (double)((int64_t)time(NULL) - night->attempt_s);
    night->attempt_s = 0;
    take_code(code, tonight);
    return night_state_write(night, err);
}

static bool add_notes(fm_text_list *argv, const fm_tonight *tonight)
{
    char note[256];
    const fm_night_state *night = &tonight->night;
    bool is_added = true;
    snprintf(note, sizeof note, "%u launches of each case in %.0f s of %.3g minutes%s.",
             night->launches, night->measured_s, tonight->policy->budget_minutes,
             night->is_cut_off ? "; the time was over before all of them were" : "");
    is_added = add_two(argv, "--note", note);
    if (night->parts > 1) {
        snprintf(note, sizeof note,
                 "Methods take turns: %zu of them tonight, part %u of %u, since not all fit.",
                 night->methods.count, night->part + 1, night->parts);
        is_added = is_added && add_two(argv, "--note", note);
    }
    return is_added;
}

static fm_status list_judge(fm_text_list *argv, const fm_tonight *tonight, const char *report,
                            const char *run, fm_error *err)
{
    char effect[32];
    const fm_policy *policy = tonight->policy;
    text_from_double(effect, policy->effect);
    const bool is_made =
        text_list_add(argv, report) && text_list_add(argv, "night") && text_list_add(argv, run) &&
        add_two(argv, "-o", tonight->night.folder) && add_two(argv, "--effect", effect) &&
        (policy->state[0] == '\0' || add_two(argv, "--state", policy->state)) &&
        (policy->baseline[0] == '\0' || add_two(argv, "--baseline", policy->baseline)) &&
        (policy->reference[0] == '\0' || add_two(argv, "--reference", policy->reference)) &&
        add_notes(argv, tonight);
    return is_made ? FM_OK : fm_fail(err, FM_NO_MEMORY, "no memory for arguments");
}

fm_status stage_judge(int *code, fm_tonight *tonight, fm_error *err)
{
    char report[FM_PATH_MAX_BYTES], run[FM_PATH_MAX_BYTES];
    fm_text_list argv = { 0 };
    if (!report_find(report))
        return fm_fail(err, FM_UNSUPPORTED, "%s", report_missing());
    fm_status status = path_join(run, tonight->night.folder, "run", err);
    if (status == FM_OK && report_execute(report, run, NULL, NULL) < 0)
        status = fm_fail(err, FM_IO, "%s cannot be executed", report);
    if (status == FM_OK)
        status = list_judge(&argv, tonight, report, run, err);
    if (status == FM_OK)
        *code = report_command(text_list_items(&argv));
    text_list_free(&argv);
    if (status == FM_OK && *code < 0)
        status = fm_fail(err, FM_IO, "%s cannot be executed", report);
    if (status != FM_OK ||
        (*code != CLI_DONE && *code != CLI_CLAIM_FAILS && *code != CLI_SOME_FAILED))
        return status; /* it is judged again when the night is continued */
    tonight->night.stage = FM_NIGHT_DONE;
    tonight->night.code = *code;
    return night_state_write(&tonight->night, err);
}
