#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "image/image_range.h"
#include "model/feeds.h"
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
    static const char *const folders[] = { "work", "truth", "images", "kept" };
    char path[FM_PATH_MAX_BYTES];
    fm_status status = run_path(path, run, "summary.csv", "", "", err);
    if (status == FM_OK && !journal_is_begun(run->desc->directory) && access(path, F_OK) == 0)
        status = fm_fail(err, FM_INVALID,
                         "%s holds results that no journal belongs to: choose another -o",
                         run->desc->directory);
    for (size_t i = 0; i < sizeof folders / sizeof folders[0] && status == FM_OK; i++) {
        if ((run->desc->no_images && strcmp(folders[i], "images") == 0) ||
            (run->desc->kept == 0 && strcmp(folders[i], "kept") == 0))
            continue;
        status = run_path(path, run, folders[i], "", "", err);
        if (status == FM_OK)
            status = path_make_folders(path, err);
    }
    return status;
}

static void remove_images(const run_state *run, size_t case_index)
{
    static const char *const endings[] = { ".rgba32f", ".truth.rgba32f", FM_RANGE_LOW_ENDING,
                                           FM_RANGE_HIGH_ENDING };
    char path[FM_PATH_MAX_BYTES];
    for (size_t i = 0; i < sizeof endings / sizeof endings[0]; i++)
        if (run_path(path, run, "images", run->plan->cases[case_index].id, endings[i], NULL) ==
            FM_OK)
            unlink(path);
}

/* Whatever this run is to keep: an earlier one may have kept more. */
static void remove_kept(const run_state *run, size_t case_index)
{
    char path[FM_PATH_MAX_BYTES], ending[32];
    for (int kind = 0; kind < KEPT_KIND_COUNT; kind++) {
        snprintf(ending, sizeof ending, ".%s", kept_names[kind]);
        if (run_path(path, run, "kept", run->plan->cases[case_index].id, ending, NULL) == FM_OK)
            unlink(path);
    }
}

fm_status run_kept_path(char path[FM_PATH_MAX_BYTES], const run_state *run, size_t case_index,
                        kept_kind kind, fm_error *err)
{
    const fm_case *planned = &run->plan->cases[case_index];
    const bool has_frames = feed_from_name(planned->feed) == FM_FEED_FRAMES;
    char ending[32];
    path[0] = '\0';
    if ((run->desc->kept & 1u << kind) == 0 || has_frames != (kind == KEPT_FRAMES))
        return FM_OK;
    snprintf(ending, sizeof ending, ".%s", kept_names[kind]);
    return run_path(path, run, "kept", planned->id, ending, err);
}

/* Only what was measured to its end has something to keep. */
static bool is_unkept(const run_state *run, size_t case_index, kept_kind kind)
{
    char path[FM_PATH_MAX_BYTES];
    const fm_case_result *result = &run->results->cases[case_index];
    return run->plan->cases[case_index].skip == NULL && result->launches[0].is_done &&
           (result->status == FM_CASE_OK || result->status == FM_CASE_WRONG_IMAGE) &&
           run_kept_path(path, run, case_index, kind, NULL) == FM_OK && path[0] != '\0' &&
           access(path, F_OK) != 0;
}

/* Whether any case of the plan has files of this kind. */
static bool keeps_once(const run_state *run, kept_kind kind)
{
    char path[FM_PATH_MAX_BYTES];
    for (size_t i = 0; i < run->plan->count; i++)
        if (run_kept_path(path, run, i, kind, NULL) == FM_OK && path[0] != '\0')
            return true;
    return run->plan->count == 0;
}

void run_tell_unkept(run_state *run)
{
    char sentence[256];
    for (int kind = 0; kind < KEPT_KIND_COUNT; kind++) {
        size_t count = 0, first = 0;
        if ((run->desc->kept & 1u << kind) != 0 && !keeps_once(run, (kept_kind)kind)) {
            snprintf(sentence, sizeof sentence, "--keep %s keeps nothing: %s", kept_names[kind],
                     kind == KEPT_FRAMES ? "no case is a sequence (feed frames)"
                                         : "all cases are sequences, which have frames instead");
            progress_tell_always(&run->progress, run->desc->directory, sentence);
        }
        for (size_t i = 0; i < run->plan->count; i++)
            if (is_unkept(run, i, (kept_kind)kind) && count++ == 0)
                first = i;
        if (count == 0) /* a plan may have no case at all */
            continue;
        snprintf(sentence, sizeof sentence,
                 "%zu rows were checked before and have no kept %s (the first: %s); they are not "
                 "checked again, so name another -o to keep theirs, too",
                 count, kept_names[kind], run->plan->cases[first].id);
        progress_tell_always(&run->progress, run->desc->directory, sentence);
    }
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
    remove_kept(run, case_index);
    run->forgotten++;
    return FM_OK;
}
