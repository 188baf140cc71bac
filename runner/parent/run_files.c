#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "run_internal.h"

fm_status run_path(char path[FM_PATH_MAX_BYTES], const run_state *run, const char *folder,
                   const char *name, const char *ending, fm_error *err)
{
    char inside[FM_PATH_MAX_BYTES];
    snprintf(inside, sizeof inside, "%s%s%s%s", folder, name[0] != '\0' ? "/" : "", name, ending);
    return path_join(path, run->desc->directory, inside, err);
}

fm_status run_make_folders(const run_state *run, fm_error *err)
{
    static const char *const folders[] = { "work", "truth", "images" };
    char path[FM_PATH_MAX_BYTES];
    fm_status status = run_path(path, run, "summary.csv", "", "", err);
    if (status == FM_OK && !journal_is_begun(run->desc->directory) && access(path, F_OK) == 0)
        status = fm_fail(err, FM_INVALID,
                         "%s holds results that no journal belongs to: choose another -o",
                         run->desc->directory);
    for (size_t i = 0; i < sizeof folders / sizeof folders[0] && status == FM_OK; i++) {
        if (run->desc->no_images && strcmp(folders[i], "images") == 0)
            continue;
        status = run_path(path, run, folders[i], "", "", err);
        if (status == FM_OK)
            status = path_make_folders(path, err);
    }
    return status;
}

static void remove_images(const run_state *run, size_t case_index)
{
    static const char *const endings[] = { ".rgba32f", ".truth.rgba32f" };
    char path[FM_PATH_MAX_BYTES];
    for (size_t i = 0; i < sizeof endings / sizeof endings[0]; i++)
        if (run_path(path, run, "images", run->plan->cases[case_index].id, endings[i], NULL) ==
            FM_OK)
            unlink(path);
}

void run_remove_truths(const run_state *run)
{
    static const char *const suffixes[] = { ".truth", ".truth.hull", ".truth.code" };
    const size_t count = sizeof suffixes / sizeof suffixes[0];
    char path[FM_PATH_MAX_BYTES];
    for (size_t i = 0; i < count * run->truths.count; i++)
        if (run_path(path, run, "truth", run->truths.jobs[i / count].name, suffixes[i % count],
                     NULL) == FM_OK)
            unlink(path);
    run_remove_folders(run);
}

void run_remove_folders(const run_state *run)
{
    char path[FM_PATH_MAX_BYTES];
    if (run_path(path, run, "truth", "", "", NULL) == FM_OK)
        rmdir(path);
    if (run_path(path, run, "work", "", "", NULL) == FM_OK)
        rmdir(path);
}

fm_status run_forget(run_state *run, size_t case_index, fm_error *err)
{
    const fm_status status = journal_write(run->journal, FM_JOURNAL_FORGET,
                                           run->plan->cases[case_index].id, 0, NULL, err);
    if (status != FM_OK) /* what the journal still has keeps its images */
        return status;
    remove_images(run, case_index);
    run->forgotten++;
    return FM_OK;
}
