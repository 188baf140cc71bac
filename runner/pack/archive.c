#include "archive.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/path.h"
#include "base/text.h"
#include "child/child.h"

enum { WAIT_S = 3600 };

static const struct {
    const char *ending, *option; /* of tar; NULL: not compressed */
} kinds[] = {
    { ".tar", NULL },      { ".tar.gz", "--gzip" },  { ".tgz", "--gzip" },
    { ".tar.xz", "--xz" }, { ".tar.zst", "--zstd" },
};
enum { KINDS = sizeof kinds / sizeof kinds[0] };

static int kind_of(const char *name)
{
    const size_t length = strlen(name);
    for (int i = 0; i < KINDS; i++) {
        const size_t ending = strlen(kinds[i].ending);
        if (length > ending && strcmp(name + length - ending, kinds[i].ending) == 0)
            return i;
    }
    return KINDS;
}

bool archive_is_named(const char *name)
{
    return kind_of(name) < KINDS;
}

int archive_stem(const char *name)
{
    const int kind = kind_of(name);
    return (int)(strlen(name) - (kind < KINDS ? strlen(kinds[kind].ending) : 0));
}

/* Runs tar; what it said, if it failed, is the message. */
static fm_status run_tar(const char *const *argv, const char *root, fm_status blame, fm_error *err)
{
    char path[FM_PATH_MAX_BYTES], log[FM_PATH_MAX_BYTES], *said = NULL;
    static const char *const added[] = { "LC_ALL=C", "TAR_OPTIONS=", NULL };
    size_t count = 0;
    pid_t pid = 0;
    int code = -1;
    fm_status status = child_find(path, sizeof path, "tar", "tar", err);
    if (status == FM_OK)
        status = path_join(log, root, "tar.log", err);
    if (status != FM_OK)
        return status;
    const fm_child_desc desc = {
        .path = path, .argv = (char *const *)(const void *)argv, .added = added, .log = log
    };
    status = child_start(&pid, &desc, err);
    if (status == FM_OK && !child_wait(&code, pid, WAIT_S, NULL))
        code = -1;
    if (status != FM_OK || code == 0)
        return status;
    if (text_read_file(&said, &count, log, 1u << 20, NULL) != FM_OK)
        said = NULL;
    status = fm_fail(err, blame, "tar failed (%d): %.400s", code, said != NULL ? said : "");
    free(said);
    return status;
}

fm_status archive_make(const char *root, const char *name, const char *output, fm_error *err)
{
    char file[FM_PATH_MAX_BYTES + 16], folder[FM_PATH_MAX_BYTES + 16];
    const char *option = kinds[kind_of(output)].option;
    snprintf(file, sizeof file, "--file=%s/archive", root);
    snprintf(folder, sizeof folder, "--directory=%s", root);
    const char *const argv[] = { "tar",
                                 "--create",
                                 "--force-local",
                                 file,
                                 folder,
                                 "--sort=name",
                                 "--owner=0",
                                 "--group=0",
                                 "--numeric-owner",
                                 option != NULL ? option : "--format=gnu",
                                 "--",
                                 name,
                                 NULL };
    return run_tar(argv, root, FM_IO, err);
}

fm_status archive_unpack(const char *root, const char *path, fm_error *err)
{
    char file[FM_PATH_MAX_BYTES + 16], folder[FM_PATH_MAX_BYTES + 16];
    snprintf(file, sizeof file, "--file=%s", path);
    snprintf(folder, sizeof folder, "--directory=%s/pack", root);
    const char *const argv[] = { "tar",  "--extract",       "--force-local",         file,
                                 folder, "--no-same-owner", "--no-same-permissions", NULL };
    const fm_status status = run_tar(argv, root, FM_INVALID, err);
    return status == FM_OK ? FM_OK : fm_error_prefix(err, "%s", path);
}
