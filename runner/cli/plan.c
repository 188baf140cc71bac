#include "plan/plan.h"

#include <stdlib.h>
#include <string.h>

#include "cli.h"
#include "parent/plan_look.h"
#include "parent/progress.h"
#include "plan/cost.h"

enum { KEY_JSON = 512 };

static const struct argp_option options[] = {
    { "json", KEY_JSON, NULL, 0, "as JSON", 3 },
    { 0 },
};

static error_t parse(int key, char *text, struct argp_state *state)
{
    fm_arguments *arguments = state->input;
    if (key != KEY_JSON)
        return cli_parse_spec(key, text, state);
    arguments->json = true;
    return 0;
}

static const struct argp argp = {
    .options = options,
    .parser = parse,
    .args_doc = "[SPEC.yml]",
    .doc =
        "Lists the cases that `fragmark run` with the same arguments would measure, and how long "
        "that may take. Measures nothing, but reads the meshes and says what is in them (-q: does "
        "not). Exit code 3: no case can run; 4: a mesh cannot be read, or a plugin is refused."
        "\v"
        "Examples:\n"
        "  fragmark plan --method kb,kplus-array -a k=4:16:*2\n"
        "  fragmark plan my.yml --json\n"
        "  fragmark plan my.yml --shard 2/16     what one of 16 machines would measure\n"
        "\n"
        "Axes, with their values and (default):",
    .children = cli_spec_children,
    .help_filter = cli_axes_help,
};

/* A key is told when the cases differ in it. */
static bool varies(const fm_plan *plan, const fm_key *key)
{
    char first[FM_PATH_MAX_BYTES], text[FM_PATH_MAX_BYTES];
    settings_text(first, &plan->cases[0].settings, key);
    for (size_t i = 1; i < plan->count; i++) {
        settings_text(text, &plan->cases[i].settings, key);
        if (strcmp(text, first) != 0)
            return true;
    }
    return false;
}

static void write_case(FILE *out, const fm_case *planned, const bool *is_told)
{
    char text[FM_PATH_MAX_BYTES];
    fprintf(out, "%s  %-16s  %-14s  %-16s  %-8s", planned->id, planned->method, planned->scene,
            planned->feed, planned->device);
    for (size_t i = 0; i < fm_key_count; i++) {
        settings_text(text, &planned->settings, &fm_keys[i]);
        if ((is_told[i] && strcmp(text, "none") != 0) ||
            (strcmp(fm_keys[i].name, "k") == 0 && planned->settings.k > 0))
            fprintf(out, "  %s=%s", fm_keys[i].name, text);
    }
    for (size_t i = 0; i < planned->choice_count; i++)
        fprintf(out, "  %s=%s", planned->choices[i].name, planned->choices[i].value);
    if (planned->skip != NULL)
        fprintf(out, "  (not run: %s%s)",
                planned->skip_status == FM_CASE_PLUGIN_ERROR ? "refused: " : "", planned->skip);
    fputc('\n', out);
}

/* The fewest launches of any case that has the most. */
static uint32_t least_launches(const fm_plan *plan)
{
    uint32_t least = plan->launches;
    for (size_t i = 0; i < plan->count; i++)
        if (plan_case_launches(plan, i) == plan->launches)
            least = plan_case_least_launches(plan, i) < least ? plan_case_least_launches(plan, i)
                                                              : least;
    return least;
}

/* "5 launches", or with a precision "5 to 40 launches"; and how long they take. */
static void say_range(char launches[48], char duration[72], const fm_plan *plan)
{
    char shortest[32], longest[32];
    const uint32_t least = least_launches(plan);
    duration_text(shortest, plan_least_seconds(plan));
    duration_text(longest, plan_seconds(plan));
    if (least == plan->launches) {
        snprintf(launches, 48, "%u launches", plan->launches);
        snprintf(duration, 72, "%s", longest);
    } else {
        snprintf(launches, 48, "%u to %u launches", least, plan->launches);
        snprintf(duration, 72, "%s to %s", shortest, longest);
    }
}

static int write_table(const fm_cli *cli, const fm_plan *plan)
{
    char launches[48], duration[72];
    size_t runnable = 0;
    bool *is_told = calloc(fm_key_count, sizeof *is_told);
    if (is_told == NULL)
        return CLI_NOTHING;
    for (size_t i = 0; i < fm_key_count && plan->count > 0; i++)
        is_told[i] = varies(plan, &fm_keys[i]);
    for (size_t i = 0; i < plan->count; i++) {
        runnable += plan->cases[i].skip == NULL;
        write_case(cli->out, &plan->cases[i], is_told);
    }
    free(is_told);
    say_range(launches, duration, plan);
    if (plan->shard.count > 0)
        fprintf(cli->talk, "shard %u of %u, of %zu cases in %zu groups that stay together: ",
                plan->shard.index, plan->shard.count, plan->shard.case_count,
                plan->shard.group_count);
    fprintf(cli->talk,
            "%zu cases, %zu to run: %s of %u frames each, seed %llu; about %s on two CPU "
            "cores (an estimate; a GPU is faster)\n",
            plan->count, runnable, launches, plan->frames, (unsigned long long)plan->seed,
            duration);
    return CLI_DONE;
}

static json_t *case_json(const fm_case *planned)
{
    char text[FM_PATH_MAX_BYTES];
    json_t *settings = json_object(), *chosen = json_object();
    for (size_t i = 0; i < fm_key_count; i++) {
        if (!key_is_read(&fm_keys[i], planned->settings.generator))
            continue;
        settings_text(text, &planned->settings, &fm_keys[i]);
        json_object_set_new(settings, fm_keys[i].name, json_string(text));
    }
    for (size_t i = 0; i < planned->choice_count; i++)
        json_object_set_new(chosen, planned->choices[i].name,
                            json_string(planned->choices[i].value));
    return json_pack("{s:s, s:s, s:s, s:s, s:s, s:o, s:o, s:s, s:s?}", "case_id", planned->id,
                     "method", planned->method, "scene", planned->scene, "device", planned->device,
                     "feed", planned->feed, "settings", settings, "options", chosen, "skip",
                     planned->skip != NULL ? planned->skip : "", "skip_status",
                     planned->skip != NULL ? case_status_name(planned->skip_status) : NULL);
}

/* Writes and drops it; false: no memory, or not written. */
static bool write_object(FILE *out, json_t *object, size_t flags)
{
    const bool is_written = object != NULL && json_dumpf(object, out, flags) == 0;
    json_decref(object);
    return is_written;
}

/* Case by case: all of a large plan as one tree takes gigabytes. */
static int write_json(const fm_cli *cli, const fm_plan *plan)
{
    bool is_written =
        fputs("{\n", cli->out) != EOF &&
        write_object(cli->out,
                     json_pack("{s:i, s:I, s:i, s:i, s:i, s:i, s:f, s:f}", "schema", 1, "seed",
                               (json_int_t)plan->seed, "launches", (int)plan->launches,
                               "launches_least", (int)least_launches(plan), "frames",
                               (int)plan->frames, "warmup", (int)plan->warmup, "estimated_s",
                               plan_seconds(plan), "estimated_least_s", plan_least_seconds(plan)),
                     JSON_EMBED) &&
        fputs(",\n\"cases\": [", cli->out) != EOF;
    for (size_t i = 0; i < plan->count && is_written; i++)
        is_written = fputs(i > 0 ? ",\n" : "\n", cli->out) != EOF &&
                     write_object(cli->out, case_json(&plan->cases[i]), JSON_INDENT(2));
    is_written = is_written && fputs("\n]}\n", cli->out) != EOF;
    if (!is_written)
        fprintf(cli->talk, "fragmark: the JSON cannot be written\n");
    return is_written ? CLI_DONE : CLI_NOTHING;
}

static bool is_unread(const fm_case *planned, const fm_text_index *unread)
{
    const char *file = settings_file(&planned->settings);
    return planned->is_unread ||
           (file != NULL && text_index_find(unread, file) != FM_TEXT_INDEX_NONE);
}

/* As a run of the plan would end. */
static int plan_code(const fm_plan *plan, const fm_text_index *unread)
{
    size_t failed = 0, runnable = 0;
    for (size_t i = 0; i < plan->count; i++) {
        const fm_case *planned = &plan->cases[i];
        const bool is_refused =
            planned->skip != NULL && planned->skip_status == FM_CASE_PLUGIN_ERROR;
        failed += is_refused || is_unread(planned, unread);
        runnable += planned->skip == NULL && !is_unread(planned, unread);
    }
    if (runnable == 0 && plan->count > 0 && plan->shard.count == 0)
        return CLI_NOTHING;
    return failed > 0 ? CLI_SOME_FAILED : CLI_DONE;
}

static int write_plan(const fm_arguments *arguments, const fm_plan *plan)
{
    const fm_cli *cli = arguments->cli;
    fm_error err = { 0 };
    fm_mesh_look meshes = { 0 };
    if (plan->unknown.status != FM_OK)
        fprintf(cli->talk, "auto and published are not worked out: %s\n", plan->unknown.message);
    int code = arguments->json ? write_json(cli, plan) : write_table(cli, plan);
    fflush(cli->out); /* the cases before what is said of their meshes */
    if (!arguments->quiet && mesh_look(&meshes, cli->talk, plan, NULL, &err) != FM_OK)
        code = cli_fail(cli, &err);
    if (code == CLI_DONE)
        code = meshes.stop_signal != 0 ? CLI_SIGNAL + meshes.stop_signal
                                       : plan_code(plan, &meshes.unread);
    text_index_free(&meshes.unread);
    return code;
}

int cli_plan(const fm_cli *cli, int argc, char **argv)
{
    int code;
    fm_arguments arguments = { .cli = cli };
    fm_plan plan = { 0 };
    fm_plugin_list plugins = { 0 };
    fm_error err = { 0 };
    argp_parse(&argp, argc, argv, 0, NULL, &arguments);
    if (arguments_plan(&plan, &plugins, &arguments, text_list_items(&arguments.positional), &err) !=
        FM_OK)
        code = cli_fail(cli, &err);
    else
        code = write_plan(&arguments, &plan);
    plan_free(&plan);
    plugin_list_close(&plugins);
    arguments_free(&arguments);
    return code;
}
