/* What workers are asked for a case, and how cases are found. */
#include "code/code_json.h"
#include "run_internal.h"
#include "worker/protocol.h"

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
                         .cache = run->desc->cache,
                         .image = "",
                         .validation = run->desc->validation,
                         .no_timers = run->desc->no_timers };
}

uint64_t run_known_driver(const run_state *run, const char *device)
{
    return (uint64_t)json_integer_value(json_object_get(run->drivers, device));
}

fm_code_places run_code_places(const run_state *run, size_t case_index)
{
    const fm_case *planned = &run->plan->cases[case_index];
    const char *floor = run->truths.jobs[run->truths.of_case[case_index]].floor;
    return (fm_code_places){
        .plugins = { [FM_CODE_OF_METHOD] = run_plugin_path(run, planned),
                     [FM_CODE_OF_FLOOR] = floor != NULL ? floor : "" },
        .common = run->plugins->common_folder,
        .program = run->program,
        .driver = run_known_driver(run, planned->device),
    };
}

void run_guess_code(const run_state *run, size_t case_index, json_t *answer)
{
    const fm_plugin_entry *entry =
        plugin_list_find(run->plugins, run->plan->cases[case_index].method);
    const fm_code_places places = run_code_places(run, case_index);
    const char *shaders[FM_MAX_PASSES + 1] = { NULL };
    size_t count = 0;
    fm_code code = { 0 };
    for (size_t i = 0; entry != NULL && entry->plugin != NULL && i < FM_MAX_PASSES; i++)
        if (entry->plugin->method->passes[i].shader != NULL)
            shaders[count++] = entry->plugin->method->passes[i].shader;
    code_guess(&code, &places, shaders);
    answer_set_code(answer, &code);
    code_free(&code);
}
