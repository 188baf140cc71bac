#include <string.h>

#include "cli.h"
#include "list_markdown.h"
#include "list_metrics.h"
#include "model/feeds.h"
#include "parent/manifest.h"
#include "scene/scene_file.h"

enum { KEY_JSON = 512, KEY_MARKDOWN, KEY_PLUGINS, DEVICES_MAX = 32 };

typedef struct list_arguments {
    const fm_cli *cli;
    const char *what;
    fm_text_list plugin_folders;
    bool json;
    bool markdown;
} list_arguments;

static const struct argp_option options[] = {
    { "json", KEY_JSON, NULL, 0, "as JSON", 0 },
    { "markdown", KEY_MARKDOWN, NULL, 0, "methods, or metrics, as the table of a document", 0 },
    { "plugin-dir", KEY_PLUGINS, "DIR", 0, "look for methods here first; repeatable", 0 },
    CLI_HELP_OPTION,
    { 0 },
};

static json_t *names_json(const char *const *names)
{
    json_t *list = json_array();
    for (; *names != NULL; names++)
        json_array_append_new(list, json_string(*names));
    return list;
}

static json_t *method_row(const fm_plugin_entry *entry)
{
    const char *feeds[FM_FEED_COUNT + 1];
    if (entry->plugin == NULL)
        return json_pack("{s:s, s:s}", "id", entry->id, "refused", entry->error.message);
    const fm_method_desc *method = entry->plugin->method;
    feed_names(feeds, method_feeds(method));
    json_t *row = method_json(method, NULL);
    json_object_set_new(row, "id", json_string(entry->id));
    json_object_set_new(row, "folder", json_string(entry->plugin->folder));
    json_object_set_new(row, "feeds", names_json(feeds));
    json_object_set_new(row, "k_max", json_integer(method->k_max));
    return row;
}

/* One line: id, title, [traits], citation. */
static void put_method(FILE *out, const fm_plugin_entry *entry)
{
    if (entry->plugin == NULL) {
        fprintf(out, "%-18s refused: %s\n", entry->id, entry->error.message);
        return;
    }
    const fm_method_desc *method = entry->plugin->method;
    fprintf(out, "%-18s %-24s [", entry->id, method->title != NULL ? method->title : "");
    list_markdown_traits(out, method->traits);
    fprintf(out, "] %s\n", method->citation != NULL ? method->citation : "");
}

static int list_methods(const list_arguments *arguments)
{
    fm_plugin_list plugins = { 0 };
    fm_error err = { 0 };
    const fm_cli *cli = arguments->cli;
    json_t *rows = json_array();
    fm_status status = cli_find_plugins(&plugins, &arguments->plugin_folders, &err);
    if (status == FM_OK)
        status = plugin_list_read_all(&plugins, &err);
    if (status != FM_OK) {
        plugin_list_close(&plugins);
        json_decref(rows);
        return cli_fail(cli, &err);
    }
    if (arguments->markdown)
        list_markdown(cli->out, &plugins);
    for (size_t i = 0; i < plugins.count; i++) {
        const fm_plugin_entry *entry = &plugins.entries[i];
        json_array_append_new(rows, method_row(entry));
        if (arguments->json || arguments->markdown)
            continue;
        put_method(cli->out, entry);
    }
    if (plugins.count == 0)
        fprintf(cli->talk, "no methods found; FRAGMARK_PLUGIN_PATH or --plugin-dir name their "
                           "folder\n");
    plugin_list_close(&plugins);
    if (arguments->json)
        return cli_print_json(cli, rows);
    json_decref(rows);
    return CLI_DONE;
}

static int list_scenes(const list_arguments *arguments)
{
    fm_scene_names scenes = { 0 };
    fm_error err = { 0 };
    const fm_cli *cli = arguments->cli;
    json_t *rows = json_array();
    if (scene_names_list(&scenes, &err) != FM_OK) {
        json_decref(rows);
        return cli_fail(cli, &err);
    }
    for (size_t i = 0; i < scenes.count; i++) {
        json_array_append_new(
            rows, json_pack("{s:s, s:s}", "name", scenes.names[i], "path", scenes.paths[i]));
        if (!arguments->json)
            fprintf(cli->out, "%-24s %s\n", scenes.names[i], scenes.paths[i]);
    }
    scene_names_free(&scenes);
    if (arguments->json)
        return cli_print_json(cli, rows);
    json_decref(rows);
    return CLI_DONE;
}

static int list_devices(const list_arguments *arguments)
{
    const fm_cli *cli = arguments->cli;
    json_t *rows = json_array();
    for (size_t d = 0; d < cli->devices->count; d++) {
        const fm_device_ops *ops = cli->devices->devices[d];
        fm_device_entry entries[DEVICES_MAX];
        size_t count = DEVICES_MAX;
        fm_error err = { 0 };
        if (ops->list(entries, &count, &err) != FM_OK) {
            fprintf(cli->talk, "%s\n", err.message); /* begins with the name */
            continue;
        }
        for (size_t i = 0; i < count && i < DEVICES_MAX; i++) {
            json_array_append_new(rows, json_pack("{s:s, s:s}", "selector", entries[i].selector,
                                                  "name", entries[i].name));
            if (!arguments->json)
                fprintf(cli->out, "%-12s %s\n", entries[i].selector, entries[i].name);
        }
    }
    if (arguments->json)
        return cli_print_json(cli, rows);
    json_decref(rows);
    return CLI_DONE;
}

static int list_figures(const list_arguments *arguments)
{
    fm_figure_list list = { 0 };
    fm_error err = { 0 };
    const fm_cli *cli = arguments->cli;
    json_t *rows = json_array();
    if (figures_list(&list, &err) != FM_OK) {
        json_decref(rows);
        return cli_fail(cli, &err);
    }
    for (size_t i = 0; i < list.count; i++) {
        const fm_figure *figure = &list.figures[i];
        json_array_append_new(rows, json_pack("{s:s, s:s, s:s}", "id", figure->id, "title",
                                              figure->title, "path", figure->path));
        if (!arguments->json)
            fprintf(cli->out, "%-20s %s\n", figure->id, figure->title);
    }
    figures_free(&list);
    if (arguments->json)
        return cli_print_json(cli, rows);
    json_decref(rows);
    return CLI_DONE;
}

static int list_metrics(const list_arguments *arguments)
{
    if (arguments->json)
        return cli_print_json(arguments->cli, list_metrics_json());
    if (arguments->markdown)
        list_metrics_markdown(arguments->cli->out);
    else
        list_metrics_text(arguments->cli->out);
    return CLI_DONE;
}

static const struct {
    const char *name;
    int (*list)(const list_arguments *);
} lists[] = {
    { "methods", list_methods }, { "scenes", list_scenes },   { "devices", list_devices },
    { "figures", list_figures }, { "metrics", list_metrics },
};
enum { LIST_COUNT = sizeof lists / sizeof lists[0] };

static void require_known(struct argp_state *state, const char *what)
{
    const char *names[LIST_COUNT];
    for (int i = 0; i < LIST_COUNT; i++) {
        names[i] = lists[i].name;
        if (what != NULL && strcmp(what, names[i]) == 0)
            return;
    }
    const char *nearest = what != NULL ? text_nearest(what, names, LIST_COUNT) : NULL;
    if (nearest != NULL)
        argp_error(state, "nothing called '%s' to list; the nearest is '%s'", what, nearest);
    else
        argp_error(state, "list what? methods, scenes, devices, figures or metrics");
}

static error_t parse(int key, char *text, struct argp_state *state)
{
    list_arguments *arguments = state->input;
    fm_error err = { 0 };
    switch (key) {
    case KEY_JSON:
        arguments->json = true;
        return 0;
    case KEY_MARKDOWN:
        arguments->markdown = true;
        return 0;
    case KEY_PLUGINS:
        if (names_add(&arguments->plugin_folders, text, &err) != FM_OK)
            cli_argp_fail(state, &err);
        return 0;
    case ARGP_KEY_ARG:
        if (arguments->what != NULL)
            argp_error(state, "'%s': one list at a time", text);
        require_known(state, text);
        arguments->what = text;
        return 0;
    case 'h':
        argp_state_help(state, state->out_stream, ARGP_HELP_STD_HELP);
        return 0;
    case ARGP_KEY_END:
        if (arguments->what == NULL)
            require_known(state, NULL);
        if (arguments->markdown && (arguments->json || (strcmp(arguments->what, "methods") != 0 &&
                                                        strcmp(arguments->what, "metrics") != 0)))
            argp_error(state, "--markdown is for methods and metrics, and without --json");
        return 0;
    default:
        return ARGP_ERR_UNKNOWN;
    }
}

static const struct argp argp = {
    .options = options,
    .parser = parse,
    .args_doc = "methods|scenes|devices|figures|metrics",
    .doc = "Lists what there is to choose from."
           "\v"
           "Examples:\n"
           "  fragmark list methods\n"
           "  fragmark list devices --json\n"
           "  fragmark list metrics\n"
           "\n" CLI_EXIT_CODES,
};

int cli_list(const fm_cli *cli, int argc, char **argv)
{
    int code = CLI_USAGE;
    list_arguments arguments = { .cli = cli };
    argp_parse(&argp, argc, argv, 0, NULL, &arguments);
    for (int i = 0; i < LIST_COUNT; i++)
        if (strcmp(arguments.what, lists[i].name) == 0)
            code = lists[i].list(&arguments);
    text_list_free(&arguments.plugin_folders);
    return code;
}
