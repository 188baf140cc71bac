#include "slurm_jobs.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "bundle/items.h"
#include "child/child.h"

enum { WAIT_S = 600 };

/* Runs a program; what it said, the caller frees. -1: it did not end. */
static fm_status execute(int *code, char **said, const char *path, const char *const *argv,
                         fm_error *err)
{
    char folder[FM_PATH_MAX_BYTES], log[FM_PATH_MAX_BYTES];
    pid_t pid = 0;
    size_t count = 0;
    *code = -1;
    *said = NULL;
    fm_status status = path_make_temporary(folder, "fragmark-slurm", err);
    if (status == FM_OK)
        status = path_join(log, folder, "log", err);
    const fm_child_desc desc = { .path = path,
                                 .argv = (char *const *)(const void *)argv,
                                 .log = log };
    if (status == FM_OK)
        status = child_start(&pid, &desc, err);
    if (status == FM_OK && !child_wait(code, pid, WAIT_S, NULL))
        *code = -1;
    if (status == FM_OK)
        status = text_read_file(said, &count, log, (size_t)256 << 20, err);
    if (folder[0] != '\0')
        tree_remove(folder);
    return status;
}

/* Those lines of what was said that begin so. */
static void tell_lines(const fm_cli *cli, const char *said, const char *start)
{
    for (const char *line = said; *line != '\0';) {
        const size_t length = strcspn(line, "\n");
        if (strncmp(line, start, strlen(start)) == 0)
            fprintf(cli->talk, "%.*s\n", (int)length, line);
        line += length + (line[length] == '\n');
    }
}

int slurm_check_plan(const fm_cli *cli, const slurm_desc *desc)
{
    char shard[32], *said = NULL;
    int code = CLI_DONE;
    fm_error err = { 0 };
    const size_t count = desc->words->count;
    if (strcmp(desc->words->items[0], "run") != 0)
        return CLI_DONE;
    const char **argv = calloc(count + 5, sizeof *argv);
    if (argv == NULL)
        return CLI_NOTHING;
    argv[0] = desc->program;
    argv[1] = "plan";
    for (size_t i = 1; i < count; i++)
        argv[i + 1] = desc->words->items[i];
    snprintf(shard, sizeof shard, "1/%u", desc->shards);
    argv[count + 1] = "-q";
    argv[count + 2] = "--shard";
    argv[count + 3] = shard;
    const fm_status status = execute(&code, &said, desc->program, argv, &err);
    if (status != FM_OK)
        code = cli_fail(cli, &err);
    else /* what is wrong, or how much the first shard is */
        tell_lines(cli, said, code == CLI_DONE || code == CLI_SOME_FAILED ? "shard " : "fragmark");
    free(said);
    free(argv);
    return code == CLI_SOME_FAILED ? CLI_DONE : code < 0 ? CLI_NOTHING : code;
}

static fm_status expect_directory(const slurm_desc *desc, const char *path, fm_error *err)
{
    fm_text command = { 0 };
    char *bytes = NULL;
    size_t count = 0;
    fm_status status = FM_OK;
    if (strpbrk(desc->directory, "%\"\\\n") != NULL)
        return fm_fail(err, FM_INVALID, "-o %s: Slurm takes no %% \" \\ in names of logs",
                       desc->directory);
    if (access(desc->directory, F_OK) != 0)
        return FM_OK;
    slurm_add_command(&command, desc);
    if (text_read_file(&bytes, &count, path, 1u << 24, NULL) != FM_OK) {
        const bool is_empty = rmdir(desc->directory) == 0;
        if (!is_empty)
            status = fm_fail(err, FM_INVALID, "%s: holds something else; name a new folder",
                             desc->directory);
    } else if (command.failed || strstr(bytes, command.bytes) == NULL)
        status = fm_fail(err, FM_INVALID,
                         "%s: is of another command; repeat that one, or name a new folder", path);
    free(bytes);
    text_free(&command);
    return status;
}

static fm_status write_script(const char *path, void (*add)(fm_text *, const slurm_desc *),
                              const slurm_desc *desc, fm_error *err)
{
    fm_text text = { 0 };
    add(&text, desc);
    const fm_status status = text.failed ? fm_fail(err, FM_NO_MEMORY, "%s: no memory", path)
                                         : text_write_file(path, text.bytes, text.length, err);
    text_free(&text);
    return status;
}

/* The id that sbatch gave: digits, before a cluster's name. */
static fm_status submit(char id[32], const char *sbatch, const char *option, const char *script,
                        fm_error *err)
{
    int code = 0;
    char *said = NULL;
    const char *const argv[] = { "sbatch", "--parsable", option != NULL ? option : script,
                                 option != NULL ? script : NULL, NULL };
    fm_status status = execute(&code, &said, sbatch, argv, err);
    const size_t length = said != NULL ? strspn(said, "0123456789") : 0;
    if (status == FM_OK && (code != 0 || length == 0 || length >= 32))
        status = fm_fail(err, FM_IO, "sbatch %s failed (%d): %.500s", script, code,
                         said != NULL ? said : "");
    if (status == FM_OK)
        snprintf(id, 32, "%.*s", (int)length, said);
    free(said);
    return status;
}

fm_status slurm_write_files(slurm_files *files, const slurm_desc *desc, fm_error *err)
{
    fm_status status = path_join(files->shards, desc->directory, "shards.sbatch", err);
    if (status == FM_OK)
        status = path_join(files->merge, desc->directory, "merge.sbatch", err);
    if (status == FM_OK)
        status = path_join(files->logs, desc->directory, "logs", err);
    if (status == FM_OK)
        status = expect_directory(desc, files->shards, err);
    if (status == FM_OK)
        status = path_make_folders(files->logs, err);
    if (status == FM_OK)
        status = write_script(files->shards, slurm_add_shards, desc, err);
    return status == FM_OK ? write_script(files->merge, slurm_add_merge, desc, err) : status;
}

int slurm_submit(const fm_cli *cli, const slurm_files *files, const slurm_desc *desc)
{
    char sbatch[FM_PATH_MAX_BYTES], array[32] = "", merge[32], after[64];
    fm_error err = { 0 };
    fm_status status = child_find(sbatch, sizeof sbatch, "sbatch", "slurm-client", &err);
    if (status == FM_OK)
        status = submit(array, sbatch, NULL, files->shards, &err);
    snprintf(after, sizeof after, "--dependency=afterany:%s", array);
    if (status == FM_OK)
        status = submit(merge, sbatch, after, files->merge, &err);
    if (status != FM_OK && array[0] != '\0')
        fprintf(cli->talk,
                "the shards are submitted as job %s, and their merge is not: sbatch %s "
                "%s\n",
                array, after, files->merge);
    if (status != FM_OK) {
        cli_fail(cli, &err);
        return status == FM_UNSUPPORTED ? CLI_NOTHING : CLI_INCOMPLETE;
    }
    fprintf(cli->out, "%s\n%s\n", array, merge);
    fprintf(cli->talk, "job %s measures %u shards, then job %s merges them into %s/merged\n", array,
            desc->shards, merge, desc->directory);
    return CLI_DONE;
}
