/* What workers are asked for a case, and how cases are found. */
#include "run_internal.h"

fm_status run_find_case(size_t *case_index, const run_state *run, const char *id, uint32_t launch,
                        fm_error *err)
{
    const size_t i = text_index_find(&run->ids, id);
    *case_index = i;
    return i == FM_TEXT_INDEX_NONE || launch >= plan_case_launches(run->plan, i)
               ? fm_fail(err, FM_INVALID, "case %.32s, launch %u is not of this plan", id, launch)
               : FM_OK;
}

uint32_t run_frames(const run_state *run, const fm_settings *settings)
{
    return generator_makes_frames(settings->generator) ? settings->sequence_frames
                                                       : run->plan->frames;
}

const char *run_plugin_path(const run_state *run, const fm_case *planned)
{
    const fm_plugin_entry *entry = plugin_list_find(run->plugins, planned->method);
    return entry != NULL && entry->plugin != NULL ? entry->plugin->path : "";
}

fm_request run_request_for(const run_state *run, const fm_case *planned, size_t job,
                           const char *truth)
{
    return (fm_request){ .device = planned->device,
                         .feed = planned->feed,
                         .settings = &planned->settings,
                         .choices = planned->choices,
                         .choice_count = planned->choice_count,
                         .plugin = run_plugin_path(run, planned),
                         .floor = run->truths.jobs[job].floor,
                         .common = run->plugins->common_folder,
                         .truth = truth,
                         .image = "",
                         .validation = run->desc->validation,
                         .no_timers = run->desc->no_timers };
}
