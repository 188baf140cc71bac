#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/path.h"
#include "cli.h"
#include "parent/run.h"
#include "plan/memory_table.h"

enum { KEY_SMOKE = 512, KEY_LARGE, KEY_REFERENCE, KEY_SEEDS };
enum { SEEDS_MAX = 100 };

static const struct argp_option options[] = {
    { "smoke", KEY_SMOKE, NULL, 0, "the figure's own small variant: minutes, no GPU needed", 0 },
    { "large", KEY_LARGE, NULL, 0, "also what takes hours without a GPU", 0 },
    { "seeds", KEY_SEEDS, "N", 0,
      "scenes made from each of the seeds 1 to N, and intervals over them (1)", 0 },
    { "reference", KEY_REFERENCE, "NAME|DIR|none", 0,
      "another machine's results beside ours in all charts; without it h100 in ratios and verdicts",
      0 },
    { 0 },
};

/* The same as `-a seed=1,2,...,N`. */
static void add_seeds(fm_arguments *arguments, struct argp_state *state, const char *text)
{
    uint64_t count = 0;
    char axis[64];
    fm_error err = { 0 };
    if (!text_to_u64(&count, text) || count == 0 || count > SEEDS_MAX)
        argp_error(state, "--seeds %s: legal is 1..%d", text, SEEDS_MAX);
    snprintf(axis, sizeof axis, "seed=1:%u:+1", (unsigned)count);
    if (names_add(&arguments->axes, axis, &err) != FM_OK)
        cli_argp_fail(state, &err);
}

static error_t parse(int key, char *text, struct argp_state *state)
{
    fm_arguments *arguments = state->input;
    switch (key) {
    case KEY_SMOKE:
        arguments->smoke = true;
        return 0;
    case KEY_LARGE:
        arguments->large = true;
        return 0;
    case KEY_SEEDS:
        add_seeds(arguments, state, text);
        return 0;
    case KEY_REFERENCE:
        arguments->reference = text;
        return 0;
    case ARGP_KEY_END:
        if (arguments->smoke && arguments->large)
            argp_error(state, "--smoke or --large, not both");
        if (arguments->positional.count == 0)
            argp_error(state, "which figure? `fragmark list figures` names them");
        return 0;
    default:
        return cli_parse_spec(key, text, state);
    }
}

static const struct argp_child children[] = {
    { &cli_running_argp, 0, "How it is run:", 1 },
    { &cli_selection_argp, 0, "Instead of what the figure says:", 2 },
    { 0 },
};
static const struct argp argp = {
    .options = options,
    .parser = parse,
    .args_doc = "FIGURE|CLAIM|PAPER|all...",
    .doc = "Measures what figures of a paper show, draws them beside the printed values and checks "
           "their claims."
           "\v"
           "Examples:\n"
           "  fragmark reproduce kplus-05 --smoke -o quick\n"
           "  fragmark reproduce kplus            all figures of that paper\n"
           "  fragmark reproduce KP-3             the figure that this claim is about\n"
           "  fragmark reproduce evr --seeds 5    its scenes made five times over\n"
           "  fragmark reproduce all --device vulkan:1\n"
           "  fragmark reproduce all --shard 2/16 -o out/2     for one of 16 machines\n"
           "\n" CLI_EXIT_CODES,
    .children = children,
};

/* Length of the paper's id at the start of a figure's: "kplus" of kplus-05, kplus-06, ... */
static size_t paper_length(const fm_figure *figure)
{
    return strcspn(figure->id, "-");
}

/* "kplus" names all of kplus-05, kplus-06, ...; KP-3 the figure that claims it. */
static bool is_meant(const fm_figure *figure, const char *name)
{
    const size_t length = strlen(name);
    return strcmp(name, "all") == 0 || strcmp(name, figure->id) == 0 ||
           (length == paper_length(figure) && strncmp(name, figure->id, length) == 0) ||
           figure_has_claim(figure, name);
}

/* All that may be asked for: papers, figures, claims, and "all". */
static fm_status add_known_names(fm_text_list *known, const fm_figure_list *list, fm_error *err)
{
    fm_status status = names_add(known, "all", err);
    for (size_t i = 0; i < list->count && status == FM_OK; i++) {
        char paper[sizeof list->figures[i].id];
        snprintf(paper, sizeof paper, "%.*s", (int)paper_length(&list->figures[i]),
                 list->figures[i].id);
        status = names_add(known, paper, err);
        if (status == FM_OK)
            status = names_add(known, list->figures[i].id, err);
        if (status == FM_OK)
            status = figure_add_claims(known, &list->figures[i], err);
    }
    return status;
}

static fm_status no_figure(const fm_figure_list *list, const char *name, fm_error *err)
{
    fm_text_list known = { 0 };
    if (list->count == 0)
        return fm_fail(err, FM_INVALID,
                       "no figures found; FRAGMARK_FIGURE_PATH names their folder");
    fm_status status = add_known_names(&known, list, err);
    if (status == FM_OK) {
        const char *nearest = text_nearest(name, text_list_items(&known), known.count);
        status = fm_fail(err, FM_INVALID,
                         "no figure, paper or claim '%s'; %s '%s' (`fragmark list figures`)", name,
                         nearest != NULL ? "the nearest is" : "there is",
                         nearest != NULL ? nearest : list->figures[0].id);
    }
    text_list_free(&known);
    return status;
}

/* Marks what the arguments mean; a name that means nothing is an error. is_chosen: one for each
 * figure, or NULL when there was no memory for it. */
static fm_status choose(bool *is_chosen, const fm_text_list *wanted, const fm_figure_list *list,
                        fm_error *err)
{
    if (is_chosen == NULL)
        return fm_fail(err, FM_NO_MEMORY, "no memory for %zu figures", list->count);
    for (size_t i = 0; i < wanted->count; i++) {
        bool is_known = false;
        for (size_t j = 0; j < list->count; j++)
            if (is_meant(&list->figures[j], wanted->items[i]))
                is_chosen[j] = is_known = true;
        if (!is_known)
            return no_figure(list, wanted->items[i], err);
    }
    return FM_OK;
}

/* What this command works on: the chosen figures that have something to run, and their specs. */
typedef struct spec_files {
    char folder[FM_PATH_MAX_BYTES];
    fm_text_list ids, paths;
    fm_text_list owners; /* of each path: a figure's id */
    const fm_figure_list *list;
    const bool *is_chosen; /* [list->count] */
    const char *command;
} spec_files;

static fm_figure_size size_of(const fm_arguments *arguments)
{
    return arguments->smoke ? FM_FIGURE_SMOKE : arguments->large ? FM_FIGURE_LARGE : FM_FIGURE_FULL;
}

static fm_status write_figure(spec_files *specs, const fm_arguments *arguments,
                              const fm_figure *figure, fm_error *err)
{
    bool is_table = false;
    fm_status status = memory_table_is_in(&is_table, figure->path, err);
    if (status == FM_OK)
        status = figure_write_specs(&specs->paths, specs->folder, figure, size_of(arguments), err);
    if (status == FM_UNSUPPORTED) {
        if (!is_table)
            fprintf(arguments->cli->talk, "left out: %s\n", err->message);
        return is_table ? names_add(&specs->ids, figure->id, err) : FM_OK;
    }
    if (status == FM_OK)
        status = names_add(&specs->ids, figure->id, err);
    while (specs->owners.count < specs->paths.count && status == FM_OK)
        status = names_add(&specs->owners, figure->id, err);
    return status;
}

static fm_status write_specs(spec_files *specs, const fm_arguments *arguments,
                             const fm_figure_list *list, const bool *is_chosen, fm_error *err)
{
    fm_status status = FM_OK;
    specs->list = list;
    specs->is_chosen = is_chosen;
    for (size_t i = 0; i < list->count && status == FM_OK; i++)
        if (is_chosen[i])
            status = write_figure(specs, arguments, &list->figures[i], err);
    return status;
}

/* First somewhere else: the folder of the results may hold the specs of another run. */
static fm_status open_specs(spec_files *specs, fm_error *err)
{
    return path_make_temporary(specs->folder, "fragmark-specs", err);
}

static void close_specs(spec_files *specs)
{
    for (size_t i = 0; i < specs->paths.count; i++)
        unlink(specs->paths.items[i]);
    if (specs->folder[0] != '\0')
        rmdir(specs->folder);
    text_list_free(&specs->ids);
    text_list_free(&specs->paths);
    text_list_free(&specs->owners);
}

/* Pictures are kept of figures that show them. */
static void choose_pictures(fm_plan *plan, const fm_text_index *ids, const fm_plan *of_figure)
{
    for (size_t i = 0; i < of_figure->count; i++) {
        const size_t found = text_index_find(ids, of_figure->cases[i].id);
        if (found != FM_TEXT_INDEX_NONE)
            plan->cases[found].no_image = false;
    }
}

static bool has_pictures(const fm_figure_list *list, const char *id)
{
    for (size_t i = 0; i < list->count; i++)
        if (strcmp(list->figures[i].id, id) == 0)
            return list->figures[i].has_pictures;
    return false;
}

/* What the plan's cases are for: csv gets the text of figures.csv (one may belong to several
 * figures), and it is said whose pictures are kept. */
static fm_status assign_cases(fm_text *csv, fm_plan *plan, const spec_files *specs,
                              const fm_arguments *arguments, const fm_plugin_list *plugins,
                              fm_error *err)
{
    fm_text_index ids = { 0 };
    fm_status status = plan_index_ids(&ids, plan)
                           ? FM_OK
                           : fm_fail(err, FM_NO_MEMORY, "no memory for %zu cases", plan->count);
    text_add(csv, "figure,case_id\n");
    for (size_t i = 0; i < plan->count; i++)
        plan->cases[i].no_image = true;
    for (size_t i = 0; i < specs->paths.count && status == FM_OK; i++) {
        fm_plan of_figure = { 0 };
        const char *id = specs->owners.items[i];
        status = arguments_expand(&of_figure, plugins, arguments, specs->paths.items[i], err);
        for (size_t j = 0; j < of_figure.count && status == FM_OK; j++)
            if (text_index_find(&ids, of_figure.cases[j].id) != FM_TEXT_INDEX_NONE)
                text_add(csv, "%s,%s\n", id, of_figure.cases[j].id);
        if (status == FM_OK && has_pictures(specs->list, id))
            choose_pictures(plan, &ids, &of_figure);
        plan_free(&of_figure);
    }
    if (status == FM_OK && csv->failed)
        status = fm_fail(err, FM_NO_MEMORY, "no memory for figures.csv");
    text_index_free(&ids);
    return status;
}

/* Figures that are tables of memory: nothing to run. */
static fm_status make_tables(fm_text *csv, const fm_cli *cli, const spec_files *specs,
                             const fm_plugin_list *plugins, fm_error *err)
{
    fm_memory_verdicts verdicts = { 0 };
    fm_status status = FM_OK;
    for (size_t i = 0; i < specs->list->count && status == FM_OK; i++) {
        const fm_figure *figure = &specs->list->figures[i];
        bool is_table = false;
        if (specs->is_chosen[i])
            status = memory_table_is_in(&is_table, figure->path, err);
        if (status == FM_OK && is_table)
            status = memory_table_make(csv, &verdicts, figure->path, figure->id, plugins, err);
    }
    if (status == FM_OK && csv->length > 0)
        fprintf(cli->talk,
                "tables of memory: %u printed values are exact, %u are errata, "
                "%u differ\n",
                verdicts.exact, verdicts.errata, verdicts.differs);
    return status;
}

/* No spec: a plan of no case. */
static fm_status make_plan(fm_plan *plan, fm_plugin_list *plugins, const fm_arguments *arguments,
                           const spec_files *specs, fm_error *err)
{
    if (specs->paths.count > 0)
        return arguments_plan(plan, plugins, arguments, text_list_items(&specs->paths), err);
    plan->launches = 1;
    const fm_status status = cli_find_plugins(plugins, &arguments->plugin_folders, err);
    return status == FM_OK ? arguments_shard(plan, arguments, err) : status;
}

static int run_specs(const spec_files *specs, const fm_arguments *arguments)
{
    int code = CLI_USAGE;
    char directory[FM_PATH_MAX_BYTES];
    fm_plan plan = { 0 };
    fm_plugin_list plugins = { 0 };
    fm_text memory = { 0 }, figure_cases = { 0 };
    fm_error err = { 0 };
    cli_directory(directory, arguments);
    const cli_run_desc desc = { .directory = directory,
                                .command = specs->command,
                                .plan = &plan,
                                .plugins = &plugins,
                                .figures = text_list_items(&specs->ids),
                                .figure_cases = &figure_cases,
                                .memory = &memory };
    if (make_plan(&plan, &plugins, arguments, specs, &err) != FM_OK ||
        make_tables(&memory, arguments->cli, specs, &plugins, &err) != FM_OK ||
        report_expect(arguments, desc.figures, &err) != FM_OK ||
        assign_cases(&figure_cases, &plan, specs, arguments, &plugins, &err) != FM_OK)
        code = cli_fail(arguments->cli, &err);
    else
        code = cli_run_plan(arguments, &desc);
    if (code != CLI_USAGE && code != CLI_DAMAGED)
        cli_keep_specs(&specs->paths, directory);
    text_free(&memory);
    text_free(&figure_cases);
    plan_free(&plan);
    plugin_list_close(&plugins);
    return code;
}

int cli_reproduce(const fm_cli *cli, int argc, char **argv)
{
    int code;
    fm_arguments arguments = { .cli = cli, .takes_figures = true };
    fm_figure_list list = { 0 };
    spec_files specs = { 0 };
    fm_error err = { 0 };
    char *command = cli_command_text(argc, argv);
    specs.command = command != NULL ? command : "";
    bool *is_chosen = NULL;
    argp_parse(&argp, argc, argv, 0, NULL, &arguments);
    fm_status status = figures_list(&list, &err);
    if (status == FM_OK) {
        is_chosen = calloc(list.count + 1, sizeof *is_chosen);
        status = choose(is_chosen, &arguments.positional, &list, &err);
    }
    if (status == FM_OK)
        status = open_specs(&specs, &err);
    if (status == FM_OK)
        status = write_specs(&specs, &arguments, &list, is_chosen, &err);
    if (status == FM_OK && specs.ids.count == 0)
        status = fm_fail(&err, FM_INVALID, "none of these figures has anything to run");
    code = status == FM_OK ? run_specs(&specs, &arguments) : cli_fail(cli, &err);
    close_specs(&specs);
    free(is_chosen);
    figures_free(&list);
    arguments_free(&arguments);
    free(command);
    return code;
}
