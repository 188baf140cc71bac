#include "plan_look.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "launch.h"
#include "worker/protocol.h"

enum { LOOK_TIMEOUT_S = 600 };

typedef struct look {
    fm_text_index *unread;
    FILE *talk;
    const char *worker;
    fm_stop_signals signals;
    int stop_signal; /* that asked to end; 0: none */
    fm_error *err;
    /* of one worker after the other */
    char folder[FM_PATH_MAX_BYTES];
    char request[FM_PATH_MAX_BYTES + 16], result[FM_PATH_MAX_BYTES + 16],
        log[FM_PATH_MAX_BYTES + 16];
} look;

static fm_status make_files(look *files)
{
    const fm_status status = path_make_temporary(files->folder, "fragmark-plan", files->err);
    snprintf(files->request, sizeof files->request, "%s/request.json", files->folder);
    snprintf(files->result, sizeof files->result, "%s/result.json", files->folder);
    snprintf(files->log, sizeof files->log, "%s/log", files->folder);
    return status;
}

static void remove_files(const look *files)
{
    unlink(files->request);
    unlink(files->result);
    unlink(files->log);
    rmdir(files->folder);
}

static bool has_mesh(const fm_case *planned)
{
    const char *key = settings_file_key(&planned->settings);
    return planned->skip == NULL && key != NULL && strcmp(key, "mesh") == 0;
}

static void tell(FILE *talk, const char *file, const json_t *answer)
{
    const json_t *mesh = answer_mesh(answer);
    const char *message = answer_message(answer);
    if (mesh != NULL)
        fprintf(talk, "%s: %s\n", file, answer_mesh_told(mesh));
    else if (strstr(message, file) != NULL)
        fprintf(talk, "not loaded: %s\n", message);
    else
        fprintf(talk, "%s: not loaded: %s\n", file, message);
}

static fm_status no_memory(fm_error *err)
{
    return fm_fail(err, FM_NO_MEMORY, "no memory for the names of meshes");
}

/* Whoever asks drops outcome->result. */
static fm_status ask(fm_launch_outcome *outcome, look *state, const fm_request *request,
                     const char *input)
{
    const fm_launch_desc desc = { .worker = state->worker,
                                  .request = state->request,
                                  .result = state->result,
                                  .log = state->log,
                                  .input = input,
                                  .timeout_s = LOOK_TIMEOUT_S };
    *outcome = (fm_launch_outcome){ 0 };
    fm_status status = request_write(state->request, request, state->err);
    if (status == FM_OK)
        status = launch_worker(outcome, &state->signals, &desc, state->err);
    state->stop_signal = outcome->stop_signal;
    return status;
}

static fm_status look_at(look *state, const fm_case *planned)
{
    fm_launch_outcome outcome;
    const fm_request request = { .is_mesh_job = true,
                                 .plugin = "",
                                 .floor = "",
                                 .common = "",
                                 .device = "",
                                 .feed = planned->feed,
                                 .settings = &planned->settings,
                                 .truth = "",
                                 .image = "" };
    fm_status status = ask(&outcome, state, &request, planned->settings.mesh);
    if (status == FM_OK && state->stop_signal == 0) {
        tell(state->talk, planned->settings.mesh, outcome.result);
        if (answer_mesh(outcome.result) == NULL &&
            text_index_add(state->unread, planned->settings.mesh, 0) == FM_TEXT_INDEX_NONE)
            status = no_memory(state->err);
    }
    json_decref(outcome.result);
    return status;
}

/* The first case of each file. */
static fm_status look_at_all(look *state, const fm_plan *plan)
{
    fm_text_index seen = { 0 };
    fm_status status = FM_OK;
    for (size_t i = 0; i < plan->count && status == FM_OK && state->stop_signal == 0; i++) {
        const fm_case *planned = &plan->cases[i];
        if (!has_mesh(planned))
            continue;
        const size_t first = text_index_add(&seen, planned->settings.mesh, i);
        if (first == FM_TEXT_INDEX_NONE)
            status = no_memory(state->err);
        else if (first == i)
            status = look_at(state, planned);
    }
    text_index_free(&seen);
    return status;
}

fm_status mesh_look(fm_mesh_look *found, FILE *talk, const fm_plan *plan, const char *worker,
                    fm_error *err)
{
    look state = { .unread = &found->unread, .talk = talk, .worker = worker, .err = err };
    size_t first = 0;
    *found = (fm_mesh_look){ 0 };
    while (first < plan->count && !has_mesh(&plan->cases[first]))
        first++;
    if (first == plan->count)
        return FM_OK;
    fm_status status = make_files(&state);
    if (status != FM_OK)
        return status;
    status = stop_signals_open(&state.signals, err);
    if (status == FM_OK) {
        status = look_at_all(&state, plan);
        found->stop_signal = state.stop_signal;
        stop_signals_close(&state.signals);
    }
    remove_files(&state);
    return status;
}

static fm_status take_device(fm_auto_device *found, const look *state, const char *name,
                             const json_t *answer)
{
    fm_answer_device device;
    if (state->stop_signal != 0)
        return fm_fail(state->err, FM_IO, "device '%s': interrupted", name);
    if (!answer_device(&device, answer))
        return fm_fail(state->err, FM_IO, "%s", answer_message(answer));
    *found = (fm_auto_device){ .is_software = device.is_software,
                               .image_layers = device.image_layers,
                               .image_max_bytes = device.image_max_bytes };
    return FM_OK;
}

static fm_status ask_device(fm_auto_device *found, look *state, const char *name)
{
    fm_settings settings;
    fm_launch_outcome outcome;
    settings_default(&settings);
    const fm_request request = { .is_device_job = true,
                                 .plugin = "",
                                 .floor = "",
                                 .common = "",
                                 .device = name,
                                 .feed = "",
                                 .settings = &settings,
                                 .truth = "",
                                 .image = "" };
    fm_status status = ask(&outcome, state, &request, NULL);
    if (status == FM_OK)
        status = take_device(found, state, name, outcome.result);
    json_decref(outcome.result);
    return status;
}

fm_status device_look(fm_auto_device *found, const void *worker, const char *device, fm_error *err)
{
    look state = { .worker = worker, .err = err };
    fm_status status = make_files(&state);
    if (status != FM_OK)
        return status;
    status = stop_signals_open(&state.signals, err);
    if (status == FM_OK) {
        status = ask_device(found, &state, device);
        stop_signals_close(&state.signals);
    }
    remove_files(&state);
    return status;
}
