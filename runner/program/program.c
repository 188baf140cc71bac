#include "program.h"

#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static const struct {
    const char *methods, *program;
} places[] = {
    { "methods", "fragmark" },
    { "lib/fragmark/methods", "bin/fragmark" },
};

static bool is_program(const char *path)
{
    struct stat info;
    return stat(path, &info) == 0 && S_ISREG(info.st_mode) && access(path, X_OK) == 0;
}

static fm_status find_program(fm_build *build, const char *path, const char *place, fm_error *err)
{
    char joined[FM_PATH_MAX_BYTES];
    fm_status status = path_join(joined, path, place, err);
    if (status != FM_OK || !is_program(joined))
        return status;
    char *whole = realpath(joined, NULL);
    if (whole == NULL || strlen(whole) >= sizeof build->program)
        status = fm_fail(err, FM_INVALID, "%s: too long a path", joined);
    else
        strcpy(build->program, whole);
    free(whole);
    return status;
}

fm_status build_find(fm_build *build, const char *path, fm_error *err)
{
    *build = (fm_build){ .program = "" };
    const fm_status status = path_is_folder(path, err);
    if (status != FM_OK)
        return status;
    for (size_t i = 0; i < sizeof places / sizeof places[0]; i++)
        if (path_join(build->methods, path, places[i].methods, NULL) == FM_OK &&
            path_is_folder(build->methods, NULL) == FM_OK)
            return find_program(build, path, places[i].program, err);
    if (strlen(path) >= FM_PATH_MAX_BYTES)
        return fm_fail(err, FM_INVALID, "%.64s...: too long a path", path);
    strcpy(build->methods, path);
    return FM_OK;
}
