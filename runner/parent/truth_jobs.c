#include "truth_jobs.h"

#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/text_index.h"
#include "model/feeds.h"

static void truth_name(char name[200], const fm_case *planned)
{
    char hash[17];
    const fm_feed_info *feed = feed_info(feed_from_name(planned->feed));
    const bool is_shared = feed != NULL && feed->is_of_rasteriser;
    settings_scene_hash(hash, &planned->settings);
    snprintf(name, 200, "%s-%s%s%s", hash, planned->device, is_shared ? "" : "-",
             is_shared ? "" : planned->feed);
    /* "vulkan:0", or a device's whole name: no slash, no blank in a file's name. */
    for (char *c = name; *c != '\0'; c++)
        if (!isalnum((unsigned char)*c) && *c != '.' && *c != '_')
            *c = '-';
}

static fm_status find_floor(fm_truth_job *job, const fm_case *planned,
                            const fm_plugin_list *plugins, fm_error *err)
{
    const fm_plugin *floor = NULL;
    if (job->floor == NULL)
        job->floor = "";
    if (planned->skip != NULL || job->floor[0] != '\0' ||
        !feed_info(feed_from_name(planned->feed))->has_floor)
        return FM_OK;
    const fm_status status = plugin_list_floor(&floor, plugins, feed_from_name(planned->feed), err);
    if (status == FM_OK)
        job->floor = floor->path;
    return status;
}

/* The job that the case needs, which is a new one if no case before needed it. */
static fm_status add_case(fm_truth_jobs *jobs, fm_text_index *names, const fm_plan *plan, size_t i,
                          fm_error *err)
{
    fm_truth_job *wanted = &jobs->jobs[jobs->count];
    truth_name(wanted->name, &plan->cases[i]);
    const size_t job = text_index_add(names, wanted->name, jobs->count);
    if (job == FM_TEXT_INDEX_NONE)
        return fm_fail(err, FM_NO_MEMORY, "no memory for %zu truths", jobs->count + 1);
    if (job == jobs->count)
        jobs->jobs[jobs->count++].of = i;
    else
        jobs->next_of_same[jobs->jobs[job].last] = i;
    jobs->jobs[job].last = i;
    jobs->of_case[i] = job;
    jobs->next_of_same[i] = FM_NO_CASE;
    return FM_OK;
}

fm_status truth_jobs_create(fm_truth_jobs *jobs, const fm_plan *plan, const fm_plugin_list *plugins,
                            fm_error *err)
{
    const size_t room = plan->count > 0 ? plan->count : 1;
    fm_text_index names = { 0 };
    fm_status status = FM_OK;
    *jobs = (fm_truth_jobs){
        .jobs = calloc(room, sizeof *jobs->jobs),
        .of_case = calloc(room, sizeof *jobs->of_case),
        .next_of_same = calloc(room, sizeof *jobs->next_of_same),
    };
    if (jobs->jobs == NULL || jobs->of_case == NULL || jobs->next_of_same == NULL) {
        truth_jobs_free(jobs);
        return fm_fail(err, FM_NO_MEMORY, "no memory for %zu cases", plan->count);
    }
    for (size_t i = 0; i < plan->count && status == FM_OK; i++) {
        status = add_case(jobs, &names, plan, i, err);
        if (status == FM_OK)
            status = find_floor(&jobs->jobs[jobs->of_case[i]], &plan->cases[i], plugins, err);
    }
    text_index_free(&names);
    if (status != FM_OK)
        truth_jobs_free(jobs);
    return status;
}

void truth_jobs_free(fm_truth_jobs *jobs)
{
    free(jobs->jobs);
    free(jobs->of_case);
    free(jobs->next_of_same);
    *jobs = (fm_truth_jobs){ 0 };
}
