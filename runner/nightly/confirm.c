#include "confirm.h"

#include <errno.h>
#include <jansson.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include "program/program.h"

/* Cases that are to be confirmed: id and method of each. */
typedef struct suspects {
    fm_text_list ids, methods;
} suspects;

static void suspects_free(suspects *of)
{
    text_list_free(&of->ids);
    text_list_free(&of->methods);
}

/* Adds a finding on time that nobody has dismissed. false: no memory. */
static bool add_suspect(suspects *to, const json_t *finding)
{
    const char *kind = json_string_value(json_object_get(finding, "kind"));
    const char *id = json_string_value(json_object_get(finding, "case_id"));
    const char *method = json_string_value(json_object_get(finding, "method"));
    if (kind == NULL || id == NULL || method == NULL || strcmp(kind, "slower") != 0 ||
        json_is_true(json_object_get(finding, "dismissed")) || text_list_has(&to->ids, id))
        return true;
    return text_list_add(&to->ids, id) && text_list_add(&to->methods, method);
}

/* Of night.json; none where it cannot be read. The caller frees, after a failure too. */
static fm_status read_suspects(suspects *found, const fm_tonight *tonight, fm_error *err)
{
    char path[FM_PATH_MAX_BYTES];
    size_t index;
    const json_t *finding;
    bool has_memory = true;
    *found = (suspects){ .ids = { 0 } };
    const fm_status status = path_join(path, tonight->night.folder, "night.json", err);
    json_t *judged = status == FM_OK ? json_load_file(path, 0, NULL) : NULL;
    json_array_foreach(json_object_get(judged, "findings"), index, finding)
    {
        has_memory = has_memory && add_suspect(found, finding);
    }
    json_decref(judged);
    return has_memory ? status : fm_fail(err, FM_NO_MEMORY, "no memory for findings");
}

bool confirm_is_wanted(const fm_tonight *tonight)
{
    suspects found;
    if (tonight->policy->base[0] == '\0' || tonight->night.gate != FM_NIGHT_GATE_NONE)
        return false;
    const bool is_wanted = read_suspects(&found, tonight, NULL) == FM_OK && found.ids.count > 0;
    suspects_free(&found);
    return is_wanted;
}

const char *confirm_reason(const fm_tonight *tonight)
{
    static const char *const reasons[] = {
        [FM_NIGHT_GATE_NONE] =
            "Findings on time are unconfirmed. With `base: DIR` in the policy, an earlier build, a "
            "gate measures them again by pairs of launches.",
        [FM_NIGHT_GATE_ANSWERED] =
            "Findings on time without an answer are unconfirmed: gate.log says why.",
        [FM_NIGHT_GATE_NO_TIME] =
            "Findings on time are unconfirmed: no time was left of the budget "
            "for a gate to come to its end.",
        [FM_NIGHT_GATE_FAILED] =
            "Findings on time are unconfirmed: the gate could not measure; gate.log says why.",
    };
    _Static_assert(sizeof reasons / sizeof reasons[0] == FM_NIGHT_GATES, "one reason a state");
    return reasons[tonight->night.gate];
}

/* NIGHT/new/METHOD leads to the folder of the plugin that the night has measured. */
static fm_status link_plugin(const fm_tonight *tonight, const fm_plugin_entry *entry, fm_error *err)
{
    char folder[FM_PATH_MAX_BYTES], link[FM_PATH_MAX_BYTES];
    fm_status status = path_join(folder, tonight->night.folder, "new", err);
    if (status == FM_OK)
        status = path_make_folders(folder, err);
    if (status == FM_OK)
        status = path_join(link, folder, entry->id, err);
    if (status != FM_OK)
        return status;
    char *object = realpath(entry->path, NULL);
    if (object != NULL)
        *strrchr(object, '/') = '\0';
    unlink(link);
    if (object == NULL || symlink(object, link) != 0)
        status =
            fm_fail(err, FM_IO, "%s: %s", object == NULL ? entry->path : link, strerror(errno));
    free(object);
    return status;
}

static bool base_has(const fm_build *base, const char *method)
{
    char name[160], path[FM_PATH_MAX_BYTES];
    snprintf(name, sizeof name, "%.64s/%.64s.so", method, method);
    return path_join(path, base->methods, name, NULL) == FM_OK && access(path, F_OK) == 0;
}

/* Leaves what the base has, too, with links to its plugins. */
static fm_status choose(suspects *chosen, const suspects *found, const fm_build *base,
                        const fm_tonight *tonight, fm_error *err)
{
    fm_plugin_list plugins = { 0 };
    fm_status status = cli_find_plugins(&plugins, &tonight->policy->plugin_folders, err);
    for (size_t i = 0; i < found->ids.count && status == FM_OK; i++) {
        const char *method = found->methods.items[i];
        const fm_plugin_entry *entry = plugin_list_find(&plugins, method);
        if (entry == NULL || !base_has(base, method))
            continue;
        if (!text_list_has(&chosen->methods, method)) {
            status = link_plugin(tonight, entry, err);
            if (status == FM_OK)
                status = names_add(&chosen->methods, method, err);
        }
        if (status == FM_OK)
            status = names_add(&chosen->ids, found->ids.items[i], err);
    }
    plugin_list_close(&plugins);
    return status;
}

/* Those of the run, but for how often it launches: a gate plans pairs. */
static bool add_axes(fm_text_list *argv, const fm_text_list *axes)
{
    static const char launches[] = "launches=";
    bool is_added = true;
    for (size_t i = 0; i < axes->count; i++)
        if (strncmp(axes->items[i], launches, sizeof launches - 1) != 0)
            is_added = is_added && tonight_add_two(argv, "-a", axes->items[i]);
    return is_added;
}

static fm_status list_arguments(fm_text_list *argv, const suspects *chosen,
                                const fm_tonight *tonight, fm_error *err)
{
    char links[FM_PATH_MAX_BYTES], gate[FM_PATH_MAX_BYTES];
    const fm_policy *policy = tonight->policy;
    fm_status status = path_join(links, tonight->night.folder, "new", err);
    if (status == FM_OK)
        status = path_join(gate, tonight->night.folder, "gate", err);
    if (status != FM_OK)
        return status;
    const bool is_made =
        text_list_add(argv, "fragmark") && text_list_add(argv, "gate") &&
        text_list_add(argv, policy->base) && text_list_add(argv, links) &&
        (policy->spec[0] == '\0' || tonight_add_two(argv, "--spec", policy->spec)) &&
        tonight_add_all(argv, "--plugin-dir", &policy->plugin_folders) &&
        tonight_add_all(argv, "--method", &chosen->methods) &&
        tonight_add_all(argv, "--scene", &policy->scenes) &&
        tonight_add_all(argv, "--device", &policy->devices) &&
        tonight_add_all(argv, "--feed", &policy->feeds) && add_axes(argv, &policy->axes) &&
        tonight_add_all(argv, "--case", &chosen->ids) && text_list_add(argv, "--no-images") &&
        tonight_add_two(argv, "-o", gate);
    return is_made ? FM_OK : fm_fail(err, FM_NO_MEMORY, "no memory for arguments");
}

/* What came of a gate, for those that it was asked for. */
static fm_status take_end(fm_night_state *night, const fm_night_end *end, fm_error *err)
{
    const bool is_judged =
        end->code == CLI_DONE || end->code == CLI_WORSE || end->code == CLI_SOME_FAILED;
    if (!end->is_cut_off && end->code > CLI_SIGNAL)
        return fm_fail(err, FM_IO, "the gate was stopped by signal %d; the same command continues",
                       end->code - CLI_SIGNAL);
    night->gate = end->is_cut_off ? FM_NIGHT_GATE_NO_TIME
                  : is_judged     ? FM_NIGHT_GATE_ANSWERED
                                  : FM_NIGHT_GATE_FAILED;
    night->stage = FM_NIGHT_JUDGES;
    return FM_OK;
}

static fm_status run_gate(fm_tonight *tonight, const fm_text_list *argv, double seconds,
                          fm_error *err)
{
    fm_night_end end;
    fm_night_state *night = &tonight->night;
    const fm_night_program program = { .log = "gate.log", .seconds = seconds };
    night->gate_attempt_s = (int64_t)time(NULL);
    fm_status status = night_state_write(night, err);
    if (status == FM_OK)
        status = tonight_execute(&end, tonight, argv, &program, err);
    if (status != FM_OK)
        return status;
    night->confirmed_s += end.seconds;
    night->gate_attempt_s = 0;
    return take_end(night, &end, err);
}

static fm_status confirm(fm_tonight *tonight, const suspects *chosen, fm_error *err)
{
    fm_text_list argv = { 0 };
    fm_night_state *night = &tonight->night;
    const double left_s =
        policy_seconds(tonight->policy, night->built_s) - night->measured_s - night->confirmed_s;
    const double seconds = tonight->is_continued ? fmax(left_s, TONIGHT_LEAST_S) : left_s;
    if (seconds < TONIGHT_LEAST_S) {
        night->gate = FM_NIGHT_GATE_NO_TIME;
        night->stage = FM_NIGHT_JUDGES;
        return FM_OK;
    }
    fprintf(tonight->cli->talk, "%zu slower: confirmed against %s, in %.0f s at most\n",
            chosen->ids.count, tonight->policy->base, seconds);
    fm_status status = list_arguments(&argv, chosen, tonight, err);
    if (status == FM_OK)
        status = run_gate(tonight, &argv, seconds, err);
    text_list_free(&argv);
    return status;
}

fm_status stage_confirm(fm_tonight *tonight, fm_error *err)
{
    fm_build base;
    fm_error why = { 0 };
    suspects found = { .ids = { 0 } }, chosen = { .ids = { 0 } };
    fm_night_state *night = &tonight->night;
    night->confirmed_s = night_confirmed_s(night);
    fm_status status = read_suspects(&found, tonight, err);
    if (status == FM_OK && build_find(&base, tonight->policy->base, &why) == FM_OK)
        status = choose(&chosen, &found, &base, tonight, err);
    if (status == FM_OK && chosen.ids.count > 0) {
        status = confirm(tonight, &chosen, err);
    } else if (status == FM_OK) {
        fprintf(tonight->cli->talk, "what is slower cannot be confirmed: %s\n",
                why.message[0] != '\0' ? why.message : "the base has none of the methods");
        night->gate = FM_NIGHT_GATE_FAILED;
        night->stage = FM_NIGHT_JUDGES;
    }
    suspects_free(&chosen);
    suspects_free(&found);
    return status == FM_OK ? night_state_write(night, err) : status;
}
