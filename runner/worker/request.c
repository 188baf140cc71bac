#include "request.h"
#include "model/feeds.h"

#include <ctype.h>
#include <jansson.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static json_t *settings_json(const fm_settings *settings)
{
    char value[FM_PATH_MAX_BYTES];
    json_t *object = json_object();
    for (size_t i = 0; i < fm_key_count; i++) {
        settings_text(value, settings, &fm_keys[i]);
        json_object_set_new(object, fm_keys[i].name, json_string(value));
    }
    return object;
}

static json_t *options_json(const fm_case *of)
{
    json_t *object = json_object();
    for (size_t i = 0; i < of->choice_count; i++)
        json_object_set_new(object, of->choices[i].name, json_string(of->choices[i].value));
    return object;
}

fm_status request_write(const char *path, const fm_request *request, fm_error *err)
{
    const fm_case *of = request->of;
    json_t *object =
        json_pack("{s:s, s:s, s:s, s:s, s:s, s:b, s:b, s:s, s:o, s:o, s:s, s:i, s:b, s:s}", "job",
                  request->is_truth_job ? "truth" : "measure", "plugin", request->plugin, "floor",
                  request->floor, "common", request->common, "device", of->device, "validation",
                  (int)request->validation, "no_timers", (int)request->no_timers, "feed", of->feed,
                  "settings", settings_json(&of->settings), "options", options_json(of), "truth",
                  request->truth, "launch", (int)request->launch, "check", (int)request->check,
                  "image", request->image);
    char *text = object != NULL ? json_dumps(object, JSON_INDENT(1)) : NULL;
    const fm_status status =
        text != NULL ? text_write_file(path, text, strlen(text), err)
                     : fm_fail(err, FM_INVALID,
                               "%s: not written: no memory, or a path that is not UTF-8", path);
    free(text);
    json_decref(object);
    return status;
}

static void truth_name(char name[200], const fm_case *of)
{
    char hash[17];
    const fm_feed_info *feed = feed_info(feed_from_name(of->feed));
    const bool is_shared = feed != NULL && feed->is_of_rasteriser;
    settings_scene_hash(hash, &of->settings);
    snprintf(name, 200, "%s-%s%s%s", hash, of->device, is_shared ? "" : "-",
             is_shared ? "" : of->feed);
    /* "vulkan:0", or a device's whole name: no slash, no blank in a file's name. */
    for (char *c = name; *c != '\0'; c++)
        if (!isalnum((unsigned char)*c) && *c != '.' && *c != '_')
            *c = '-';
}

static fm_status find_floor(fm_truth_job *job, const fm_case *of, const fm_plugin_list *plugins,
                            fm_error *err)
{
    const fm_plugin *floor = NULL;
    if (job->floor == NULL)
        job->floor = "";
    if (of->skip[0] != '\0' || job->floor[0] != '\0' ||
        !feed_info(feed_from_name(of->feed))->has_floor)
        return FM_OK;
    const fm_status status = plugin_list_floor(&floor, plugins, feed_from_name(of->feed), err);
    if (status == FM_OK)
        job->floor = floor->path;
    return status;
}

fm_status truth_jobs_create(fm_truth_jobs *jobs, const fm_plan *plan, const fm_plugin_list *plugins,
                            fm_error *err)
{
    const size_t room = plan->count > 0 ? plan->count : 1;
    fm_status status = FM_OK;
    *jobs = (fm_truth_jobs){
        .jobs = calloc(room, sizeof *jobs->jobs),
        .of_case = calloc(room, sizeof *jobs->of_case),
    };
    if (jobs->jobs == NULL || jobs->of_case == NULL) {
        truth_jobs_free(jobs);
        return fm_fail(err, FM_NO_MEMORY, "no memory for %zu cases", plan->count);
    }
    for (size_t i = 0; i < plan->count && status == FM_OK; i++) {
        fm_truth_job *wanted = &jobs->jobs[jobs->count];
        size_t job = 0;
        truth_name(wanted->name, &plan->cases[i]);
        while (strcmp(jobs->jobs[job].name, wanted->name) != 0)
            job++;
        if (job == jobs->count)
            jobs->jobs[jobs->count++].of = i;
        jobs->of_case[i] = job;
        status = find_floor(&jobs->jobs[job], &plan->cases[i], plugins, err);
    }
    if (status != FM_OK)
        truth_jobs_free(jobs);
    return status;
}

void truth_jobs_free(fm_truth_jobs *jobs)
{
    free(jobs->jobs);
    free(jobs->of_case);
    *jobs = (fm_truth_jobs){ 0 };
}
