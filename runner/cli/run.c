#include "parent/run.h"

#include <math.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#include "cache/cache.h"
#include "cli.h"
#include "model/feeds.h"

static const struct argp argp = {
    .parser = cli_parse_spec,
    .args_doc = "[SPEC.yml]",
    .doc =
        "Measures methods on scenes: times, memory and errors as CSV, charts and a report."
        "\v"
        "Examples:\n"
        "  fragmark run --method kb,kplus-array -a k=4:16:*2 -o first\n"
        "  fragmark run --method all --device vulkan,osmesa -a n=32 -a launches=3\n"
        "  fragmark run my.yml --scene bunny -o my-results\n"
        "  fragmark run my.yml --shard 2/16 -o shards/2     then: fragmark merge shards/* -o all\n"
        "\n"
        "A run that was stopped, or killed, goes on when the same command is given with the "
        "same -o. Results: DIR/summary.csv (a row a case), DIR/samples.csv (a row a sample), "
        "DIR/manifest.json, DIR/report.html. A time is the median of the launches' medians, with "
        "a 95 % interval by launches beside it (frame_ms_low, frame_ms_high); of one launch there "
        "is none. Column noisy says why a time cannot be relied on.\n"
        "\n"
        "Axes, with their values and (default):",
    .children = cli_spec_children,
    .help_filter = cli_axes_help,
};

void cli_directory(char directory[FM_PATH_MAX_BYTES], const fm_arguments *arguments)
{
    struct tm utc;
    const time_t now = time(NULL);
    if (arguments->directory != NULL) {
        snprintf(directory, FM_PATH_MAX_BYTES, "%s", arguments->directory);
        return;
    }
    gmtime_r(&now, &utc);
    strftime(directory, FM_PATH_MAX_BYTES, "out-%Y%m%dT%H%M%SZ", &utc);
}

void cli_cache(char folder[FM_PATH_MAX_BYTES], const fm_arguments *arguments)
{
    cache_find_folder(folder);
    if (arguments->no_cache)
        folder[0] = '\0';
}

void cli_keep_specs(const fm_text_list *paths, const char *directory)
{
    char path[3 * FM_PATH_MAX_BYTES];
    snprintf(path, sizeof path, "%s/specs", directory);
    if (paths->count > 0)
        mkdir(path, 0777);
    for (size_t i = 0; i < paths->count; i++) {
        char *bytes = NULL;
        size_t count = 0;
        const char *slash = strrchr(paths->items[i], '/');
        snprintf(path, sizeof path, "%s/specs/%s", directory,
                 slash != NULL ? slash + 1 : paths->items[i]);
        if (text_read_file(&bytes, &count, paths->items[i], 1u << 20, NULL) == FM_OK)
            text_write_file(path, bytes, count, NULL);
        free(bytes);
    }
}

void cli_add_word(fm_text *text, const char *word)
{
    const bool is_plain =
        word[0] != '\0' && word[strcspn(word, " \t\n'\"*?$`\\()[]{}<>|&;#~!")] == '\0';
    if (is_plain) {
        text_add(text, "%s", word);
        return;
    }
    text_add(text, "'");
    for (const char *c = word; *c != '\0'; c++)
        text_add(text, *c == '\'' ? "'\\''" : "%c", *c);
    text_add(text, "'");
}

char *cli_command_text(int argc, char **argv)
{
    fm_text text = { 0 };
    text_add(&text, "%s", argv[0]); /* "fragmark NAME": our own, two words */
    for (int i = 1; i < argc; i++) {
        text_add(&text, " ");
        cli_add_word(&text, argv[i]);
    }
    if (text.failed)
        text_free(&text);
    return text.bytes;
}

static int exit_code(const fm_run_result *result, const fm_plan *plan)
{
    if (result->stop_signal != 0)
        return CLI_SIGNAL + result->stop_signal;
    if (result->failed > 0)
        return CLI_SOME_FAILED;
    /* A shard may have nothing but cases that cannot run: the whole has others. */
    const bool needs_none = plan->count == 0 || plan->shard.count > 0;
    return result->ok > 0 || needs_none ? CLI_DONE : CLI_NOTHING;
}

/* Whoever reads a time must know what it was measured beside. */
static void tell_noise(FILE *talk, const fm_run_result *result)
{
    fprintf(talk, "NOISY: %u of the rows cannot be relied on (column noisy)", result->noisy);
    if (!isnan(result->waited_share))
        fprintf(talk, "; threads waited for a processor %.0f %% of the time",
                100.0 * result->waited_share);
    if (!isnan(result->load))
        fprintf(talk, ", load average up to %.1f on %ld processors", result->load,
                sysconf(_SC_NPROCESSORS_ONLN));
    fputc('\n', talk);
}

/* Sequences of the simulated GPU have no times. */
static bool is_timed_once(const fm_plan *plan)
{
    bool is_timed = false;
    for (size_t i = 0; i < plan->count; i++)
        is_timed = is_timed || (plan->cases[i].skip == NULL &&
                                feed_from_name(plan->cases[i].feed) != FM_FEED_FRAMES);
    return is_timed && plan->launches == 1;
}

static void sum_up(const fm_arguments *arguments, const fm_run_result *result,
                   const cli_run_desc *desc)
{
    FILE *talk = arguments->cli->talk;
    if (result->stop_signal != 0)
        fprintf(talk, "interrupted, nothing is lost: continue with the same command: %s%s%s\n",
                desc->command, arguments->directory == NULL ? " -o " : "",
                arguments->directory == NULL ? desc->directory : "");
    if (desc->plan->count == 0 || !result->is_counted)
        return;
    fprintf(talk, "%s/summary.csv: %u ok, %u not supported, %u failed", desc->directory, result->ok,
            result->not_supported, result->failed);
    if (result->skipped > 0)
        fprintf(talk, ", %u not finished", result->skipped);
    fputc('\n', talk);
    if (is_timed_once(desc->plan) && result->ok > 0)
        fprintf(talk, "one launch: times have no interval, and decide no claim; "
                      "three launches (-a launches=3) are the least that is of use\n");
    if (result->noisy > 0)
        tell_noise(talk, result);
    cli_reasons(talk, desc->directory);
}

static fm_status keep_memory(const cli_run_desc *desc, fm_error *err)
{
    char path[FM_PATH_MAX_BYTES + 16];
    if (desc->memory == NULL || desc->memory->length == 0)
        return FM_OK;
    snprintf(path, sizeof path, "%s/memory.csv", desc->directory);
    return text_write_file(path, desc->memory->bytes, desc->memory->length, err);
}

/* A plan may be for another machine; a run is for this one. */
static fm_status expect_devices(const fm_device_list *devices, const fm_plan *plan, fm_error *err)
{
    fm_status status = FM_OK;
    for (size_t i = 0; i < plan->count && status == FM_OK; i++)
        if (i == 0 || strcmp(plan->cases[i].device, plan->cases[i - 1].device) != 0)
            status = device_expect(devices, plan->cases[i].device, err);
    return status;
}

static int fail_run(const fm_arguments *arguments, const fm_run_result *result, const fm_error *err)
{
    const int code = cli_fail(arguments->cli, err);
    if (result->is_other_code)
        return CLI_OTHER_CODE;
    if (err->status != FM_IO && err->status != FM_NO_MEMORY)
        return code;
    return result->is_damaged ? CLI_DAMAGED : CLI_INCOMPLETE;
}

int cli_run_plan(const fm_arguments *arguments, const cli_run_desc *desc)
{
    fm_error err = { 0 };
    fm_run_result result = { 0 };
    char cache[FM_PATH_MAX_BYTES];
    cli_cache(cache, arguments);
    const fm_run_desc run = {
        .directory = desc->directory,
        .command = desc->command,
        .validation = arguments->validation,
        .no_timers = arguments->no_timers,
        .no_images = arguments->no_images,
        .retried = arguments->retried,
        .kept = arguments->kept,
        .is_fresh = arguments->fresh,
        .cache = cache,
        .timeout_s = arguments->timeout_s,
        .memory_bytes = arguments->memory_bytes,
        .progress = arguments->quiet ? NULL : arguments->cli->talk,
        .talk = arguments->cli->talk,
        .figures = desc->figures,
        .figure_cases = desc->figure_cases,
    };
    if (expect_devices(arguments->cli->devices, desc->plan, &err) != FM_OK)
        return cli_fail(arguments->cli, &err);
    if (desc->plan->unknown.status != FM_OK) {
        cli_fail(arguments->cli, &desc->plan->unknown);
        return CLI_INCOMPLETE; /* the device may be there another time */
    }
    /* Who reads the talk may go (`| head`): that costs the talk, and not a run of hours. */
    signal(SIGPIPE, SIG_IGN);
    fm_status status = run_cases(&result, desc->plan, desc->plugins, &run, &err);
    if (status == FM_OK)
        status = keep_memory(desc, &err);
    const int failed = status != FM_OK ? fail_run(arguments, &result, &err) : CLI_DONE;
    if (status == FM_OK || failed == CLI_INCOMPLETE)
        sum_up(arguments, &result, desc);
    if (status != FM_OK)
        return failed;
    const int code = exit_code(&result, desc->plan);
    const int reported =
        result.stop_signal == 0 && !arguments->no_report
            ? cli_draw_report(arguments->cli, desc->directory, arguments->reference)
            : CLI_DONE;
    return reported != CLI_DONE ? reported : code;
}

int cli_run(const fm_cli *cli, int argc, char **argv)
{
    int code;
    fm_arguments arguments = { .cli = cli };
    fm_plan plan = { 0 };
    fm_plugin_list plugins = { 0 };
    fm_error err = { 0 };
    const char *const none[] = { NULL };
    char directory[FM_PATH_MAX_BYTES];
    char *command = cli_command_text(argc, argv);
    argp_parse(&argp, argc, argv, 0, NULL, &arguments);
    cli_directory(directory, &arguments);
    if (arguments_plan(&plan, &plugins, &arguments, text_list_items(&arguments.positional), &err) !=
            FM_OK ||
        report_expect(&arguments, none, &err) != FM_OK)
        code = cli_fail(cli, &err);
    else {
        const cli_run_desc desc = { .directory = directory,
                                    .command = command != NULL ? command : "",
                                    .plan = &plan,
                                    .plugins = &plugins,
                                    .figures = none };
        code = cli_run_plan(&arguments, &desc);
        if (code != CLI_USAGE && code != CLI_DAMAGED)
            cli_keep_specs(&arguments.positional, directory);
    }
    plan_free(&plan);
    plugin_list_close(&plugins);
    arguments_free(&arguments);
    free(command);
    return code;
}
