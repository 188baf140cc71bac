#include "state.h"

#include <stdio.h>
#include <stdlib.h>

/* NULL: not set. */
static const char *absolute(const char *variable)
{
    const char *value = getenv(variable);
    return value != NULL && value[0] == '/' ? value : NULL;
}

static fm_status find_folder(char folder[FM_PATH_MAX_BYTES], const char *given, fm_error *err)
{
    const char *state = absolute("XDG_STATE_HOME"), *home = absolute("HOME");
    if (given != NULL)
        return snprintf(folder, FM_PATH_MAX_BYTES, "%s", given) < FM_PATH_MAX_BYTES
                   ? FM_OK
                   : fm_fail(err, FM_INVALID, "--state %.64s...: too long a path", given);
    if (state != NULL)
        return path_join(folder, state, "fragmark", err);
    if (home != NULL)
        return path_join(folder, home, ".local/state/fragmark", err);
    return fm_fail(err, FM_INVALID,
                   "neither XDG_STATE_HOME nor HOME is set: --state DIR says "
                   "where to remember");
}

fm_status state_path(char path[FM_PATH_MAX_BYTES], const char *given, const char *name,
                     bool is_written, fm_error *err)
{
    char folder[FM_PATH_MAX_BYTES];
    path[0] = '\0';
    fm_status status = find_folder(folder, given, err);
    if (status == FM_OK && is_written)
        status = path_make_folders(folder, err);
    return status == FM_OK ? path_join(path, folder, name, err) : status;
}
