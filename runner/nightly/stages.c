#include "stages.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "build.h"
#include "confirm.h"

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
        tonight_add_all(argv, "--plugin-dir", &policy->plugin_folders) &&
        tonight_add_all(argv, "--method",
                        night->methods.count > 0 ? &night->methods : &policy->methods) &&
        tonight_add_all(argv, "--scene", &policy->scenes) &&
        tonight_add_all(argv, "--device", &policy->devices) &&
        tonight_add_all(argv, "--feed", &policy->feeds) &&
        tonight_add_all(argv, "-a", &policy->axes) && tonight_add_two(argv, "-a", launches) &&
        tonight_add_two(argv, "-o", run) && text_list_add(argv, "--no-report");
    return is_made ? FM_OK : fm_fail(err, FM_NO_MEMORY, "no memory for arguments");
}

/* What the run ended with, as the night sees it. */
static void take_code(int *code, fm_tonight *tonight, const fm_night_end *end)
{
    fm_night_state *night = &tonight->night;
    const bool has_results = night_launches_ended(night) > 0; /* summary.csv is there before */
    *code = end->code;
    night->is_cut_off = end->is_cut_off;
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
    fm_night_end end;
    fm_night_state *night = &tonight->night;
    night->measured_s = night_measured_s(night);
    night->attempt_s = (int64_t)time(NULL);
    const double budget_s =
        policy_launch_share(tonight->policy) * policy_seconds(tonight->policy, night->built_s);
    const double left_s = budget_s - night->measured_s;
    const fm_night_program program = {
        .log = "run.log",
        .seconds = tonight->is_continued ? fmax(left_s, TONIGHT_LEAST_S) : left_s,
    };
    fm_status status = path_join(run, night->folder, "run", err);
    if (status == FM_OK)
        status = list_arguments(&argv, tonight, run, err);
    if (status == FM_OK)
        status = night_state_write(night, err);
    if (status == FM_OK)
        status = tonight_execute(&end, tonight, &argv, &program, err);
    text_list_free(&argv);
    if (status != FM_OK)
        return status;
    night->measured_s += (double)((int64_t)time(NULL) - night->attempt_s);
    night->attempt_s = 0;
    take_code(code, tonight, &end);
    return night_state_write(night, err);
}

static bool add_build(fm_text_list *argv, const fm_tonight *tonight)
{
    fm_text note = { 0 };
    if (tonight->policy->build.count == 0)
        return true;
    build_add_note(&note, tonight);
    const bool is_added = !note.failed && tonight_add_two(argv, "--note", note.bytes);
    text_free(&note);
    return is_added;
}

/* What a gate said, or why none did. */
static bool add_gate(fm_text_list *argv, const fm_tonight *tonight)
{
    char answers[FM_PATH_MAX_BYTES];
    if (tonight->night.gate == FM_NIGHT_GATE_ANSWERED &&
        (path_join(answers, tonight->night.folder, "gate/ab.csv", NULL) != FM_OK ||
         !tonight_add_two(argv, "--gate", answers)))
        return false;
    return tonight_add_two(argv, "--unconfirmed", confirm_reason(tonight));
}

static bool add_notes(fm_text_list *argv, const fm_tonight *tonight)
{
    char note[256];
    const fm_night_state *night = &tonight->night;
    bool is_added = true;
    snprintf(note, sizeof note, "%u launches of each case in %.0f s of %.3g minutes%s.",
             night->launches, night->measured_s, tonight->policy->budget_minutes,
             night->is_cut_off ? "; the time was over before all of them were" : "");
    is_added = tonight_add_two(argv, "--note", note);
    if (night->parts > 1) {
        snprintf(note, sizeof note,
                 "Methods take turns: %zu of them tonight, part %u of %u, since not all fit.",
                 night->methods.count, night->part + 1, night->parts);
        is_added = is_added && tonight_add_two(argv, "--note", note);
    }
    return is_added && add_build(argv, tonight);
}

static fm_status list_judge(fm_text_list *argv, const fm_tonight *tonight, const char *report,
                            const char *run, fm_error *err)
{
    char effect[32];
    const fm_policy *policy = tonight->policy;
    text_from_double(effect, policy->effect);
    const bool is_made =
        text_list_add(argv, report) && text_list_add(argv, "night") && text_list_add(argv, run) &&
        tonight_add_two(argv, "-o", tonight->night.folder) &&
        tonight_add_two(argv, "--effect", effect) &&
        (policy->state[0] == '\0' || tonight_add_two(argv, "--state", policy->state)) &&
        (policy->baseline[0] == '\0' || tonight_add_two(argv, "--baseline", policy->baseline)) &&
        (policy->reference[0] == '\0' || tonight_add_two(argv, "--reference", policy->reference)) &&
        add_notes(argv, tonight) && add_gate(argv, tonight);
    return is_made ? FM_OK : fm_fail(err, FM_NO_MEMORY, "no memory for arguments");
}

fm_status stage_judge(int *code, fm_tonight *tonight, fm_error *err)
{
    char report[FM_PATH_MAX_BYTES], run[FM_PATH_MAX_BYTES];
    fm_text_list argv = { 0 };
    if (!report_find(report))
        return fm_fail(err, FM_UNSUPPORTED, "%s", report_missing());
    fm_status status = path_join(run, tonight->night.folder, "run", err);
    if (status == FM_OK && tonight->night.gate == FM_NIGHT_GATE_NONE && /* else it was drawn */
        report_execute(report, run, NULL, NULL) < 0)
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
    tonight->night.stage = confirm_is_wanted(tonight) ? FM_NIGHT_CONFIRMS : FM_NIGHT_DONE;
    tonight->night.code = *code;
    return night_state_write(&tonight->night, err);
}
