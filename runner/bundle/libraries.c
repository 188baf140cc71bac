#include "libraries.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/path.h"
#include "child/child.h"

enum { LDD_WAIT_S = 120, ANSWER_MAX_BYTES = 1 << 22 };

/* What comes with glibc 2.36, by the name before ".so". */
static const char *const of_glibc[] = {
    "libBrokenLocale", "libanl", "libc",       "libc_malloc_debug", "libdl", "libm",
    "libmvec",         "libnsl", "libpthread", "libresolv",         "librt", "libthread_db",
    "libutil",
};

static bool is_of_glibc(const char *path)
{
    const char *slash = strrchr(path, '/'), *name = slash != NULL ? slash + 1 : path;
    const char *ending = strstr(name, ".so");
    const size_t length = ending != NULL ? (size_t)(ending - name) : strlen(name);
    if (strncmp(name, "ld-linux", strlen("ld-linux")) == 0 ||
        strncmp(name, "libnss_", strlen("libnss_")) == 0)
        return true;
    for (size_t i = 0; i < sizeof of_glibc / sizeof of_glibc[0]; i++)
        if (strlen(of_glibc[i]) == length && strncmp(of_glibc[i], name, length) == 0)
            return true;
    return false;
}

/* "	libz.so.1 => /lib/x86_64-linux-gnu/libz.so.1 (0x00007f...)" */
static fm_status read_line(fm_text_list *paths, char *line, fm_error *err)
{
    char *arrow = strstr(line, " => "), *path = arrow != NULL ? arrow + strlen(" => ") : NULL;
    if (path == NULL)
        return FM_OK; /* a file's name, the loader, or the kernel's page */
    if (strncmp(path, "not found", strlen("not found")) == 0)
        return fm_fail(err, FM_IO, "library %.*s: not found",
                       (int)(arrow - line - (line[0] == '\t')), line + (line[0] == '\t'));
    char *address = strstr(path, " (0x");
    if (address != NULL)
        *address = '\0';
    if (path[0] != '/' || is_of_glibc(path) || text_list_has(paths, path))
        return FM_OK;
    return text_list_add(paths, path) ? FM_OK
                                      : fm_fail(err, FM_NO_MEMORY, "no memory for libraries");
}

static fm_status read_answer(fm_text_list *paths, const char *log, fm_error *err)
{
    char *bytes = NULL;
    size_t count = 0;
    fm_status status = text_read_file(&bytes, &count, log, ANSWER_MAX_BYTES, err);
    char *rest = bytes;
    for (char *line; status == FM_OK && (line = strsep(&rest, "\n")) != NULL;)
        status = read_line(paths, line, err);
    free(bytes);
    return status;
}

fm_status libraries_find(fm_text_list *paths, const fm_text_list *programs, const char *log,
                         fm_error *err)
{
    char path[FM_PATH_MAX_BYTES];
    pid_t pid = 0;
    int code = 0;
    fm_status status = child_find(path, sizeof path, "ldd", "libc-bin", err);
    const char **argv = calloc(programs->count + 2, sizeof *argv);
    if (status == FM_OK && argv == NULL)
        status = fm_fail(err, FM_NO_MEMORY, "no memory for %zu programs", programs->count);
    if (status == FM_OK) {
        argv[0] = "ldd";
        memcpy(&argv[1], programs->items, programs->count * sizeof *argv);
        char *const *passed = (char *const *)(const void *)argv;
        const char *const added[] = { "LC_ALL=C", NULL };
        status = child_start(
            &pid, &(fm_child_desc){ .path = path, .argv = passed, .added = added, .log = log },
            err);
    }
    free(argv);
    if (status == FM_OK && !child_wait(&code, pid, LDD_WAIT_S, NULL))
        status = fm_fail(err, FM_IO, "ldd did not end within %d s", LDD_WAIT_S);
    if (status == FM_OK)
        status = read_answer(paths, log, err);
    return status == FM_OK && code != 0 ? fm_fail(err, FM_IO, "ldd: exit code %d", code) : status;
}
