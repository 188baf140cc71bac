#include "results_folder.h"

#include <dirent.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/path.h"
#include "model/exit_code.h"

static bool holds(const char *directory, const char *file)
{
    char path[FM_PATH_MAX_BYTES];
    return path_join(path, directory, file, NULL) == FM_OK && access(path, F_OK) == 0;
}

static bool holds_results(const char *directory)
{
    return holds(directory, "summary.csv") || holds(directory, "manifest.json");
}

/* Whoever named the parent of several runs, or of one, is told its first. */
static fm_status tell_below(const char *directory, struct dirent *const *names, int count,
                            fm_error *err)
{
    char below[FM_PATH_MAX_BYTES];
    for (int i = 0; i < count; i++)
        if (names[i]->d_name[0] != '.' &&
            path_join(below, directory, names[i]->d_name, NULL) == FM_OK && holds_results(below))
            return fm_fail(err, FM_INVALID,
                           "%s: holds no results: no summary.csv; did you mean %s?", directory,
                           below);
    return count <= 2 /* . and .. */
               ? fm_fail(err, FM_INVALID, "%s: is empty: no results", directory)
               : fm_fail(err, FM_INVALID, "%s: holds no results: no summary.csv", directory);
}

fm_status results_folder_check(const char *directory, fm_error *err)
{
    struct dirent **names = NULL;
    if (path_is_folder(directory, err) != FM_OK)
        return FM_INVALID;
    if (holds_results(directory))
        return FM_OK;
    const int count = scandir(directory, &names, NULL, alphasort);
    if (count < 0)
        return fm_fail(err, FM_INVALID, "%s: %s", directory, strerror(errno));
    const fm_status status = tell_below(directory, names, count, err);
    for (int i = 0; i < count; i++)
        free(names[i]);
    free(names);
    return status;
}

int results_exit_code(fm_status status)
{
    switch (status) {
    case FM_OK:
        return FM_EXIT_DONE;
    case FM_UNSUPPORTED:
        return FM_EXIT_USAGE;
    case FM_INVALID:
        return FM_EXIT_DAMAGED;
    default:
        return FM_EXIT_INCOMPLETE;
    }
}
