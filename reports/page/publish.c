#include "publish.h"

#include <dirent.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/path.h"

enum { HEAD_BYTES = 4096 };

/* A visit to each file of a folder that is a chart's. */
typedef fm_status chart_visit(const char *directory, const char *name, fm_error *err);

static bool is_chart(const char *name)
{
    const char *ending = strrchr(name, '.');
    return ending != NULL && (strcmp(ending, ".svg") == 0 || strcmp(ending, ".png") == 0);
}

static fm_status chart_path(char path[FM_PATH_MAX_BYTES], const char *directory, const char *folder,
                            const char *name, fm_error *err)
{
    char file[512];
    snprintf(file, sizeof file, "%s/%.300s", folder, name);
    return path_join(path, directory, file, err);
}

static fm_status visit_charts(const char *directory, const char *folder, chart_visit *visit,
                              fm_error *err)
{
    char path[FM_PATH_MAX_BYTES];
    const struct dirent *file;
    fm_status status = path_join(path, directory, folder, err);
    DIR *files = status == FM_OK ? opendir(path) : NULL;
    if (status == FM_OK && files == NULL)
        return fm_fail(err, FM_IO, "%s: %s", path, strerror(errno));
    while (status == FM_OK && (file = readdir(files)) != NULL)
        if (is_chart(file->d_name))
            status = visit(directory, file->d_name, err);
    if (files != NULL)
        closedir(files);
    return status;
}

static fm_status remove_partial(const char *directory, const char *name, fm_error *err)
{
    char path[FM_PATH_MAX_BYTES];
    const fm_status status = chart_path(path, directory, FM_PUBLISH_CHARTS, name, err);
    return status != FM_OK || unlink(path) == 0
               ? status
               : fm_fail(err, FM_IO, "%s: %s", path, strerror(errno));
}

static fm_status make_folder(const char *directory, const char *name, fm_error *err)
{
    char path[FM_PATH_MAX_BYTES];
    const fm_status status = path_join(path, directory, name, err);
    return status != FM_OK || mkdir(path, 0777) == 0 || errno == EEXIST
               ? status
               : fm_fail(err, FM_IO, "%s: %s", path, strerror(errno));
}

/* What the report that is there lacked; SIZE_MAX: there is none. */
static size_t missing_before(const char *path)
{
    char head[HEAD_BYTES + 1] = "";
    FILE *file = fopen(path, "rbe");
    if (file == NULL)
        return SIZE_MAX;
    head[fread(head, 1, HEAD_BYTES, file)] = '\0';
    fclose(file);
    const char *mark = strstr(head, FM_PUBLISH_MARK);
    return mark == NULL ? 0 : (size_t)strtoul(mark + sizeof FM_PUBLISH_MARK - 1, NULL, 10);
}

fm_status publish_begin(const char *directory, size_t missing_count, fm_error *err)
{
    char path[FM_PATH_MAX_BYTES];
    fm_status status = path_join(path, directory, "report.html", err);
    if (status == FM_OK && missing_before(path) < missing_count)
        status =
            fm_fail(err, FM_INVALID,
                    "%s was made of results that lacked less than these do, and stays: move it "
                    "away to have a report of what is left",
                    path);
    if (status == FM_OK)
        status = make_folder(directory, FM_PUBLISH_CHARTS, err);
    return status == FM_OK ? visit_charts(directory, FM_PUBLISH_CHARTS, remove_partial, err)
                           : status;
}

/* A chart of before, unless a new one takes its place. */
static fm_status remove_old(const char *directory, const char *name, fm_error *err)
{
    char path[FM_PATH_MAX_BYTES], successor[FM_PATH_MAX_BYTES];
    fm_status status = chart_path(path, directory, "charts", name, err);
    if (status == FM_OK)
        status = chart_path(successor, directory, FM_PUBLISH_CHARTS, name, err);
    if (status != FM_OK || access(successor, F_OK) == 0 || unlink(path) == 0)
        return status;
    return fm_fail(err, FM_IO, "%s: %s", path, strerror(errno));
}

static fm_status put_in_place(const char *from, const char *to, fm_error *err)
{
    return rename(from, to) == 0 ? FM_OK : fm_fail(err, FM_IO, "%s: %s", to, strerror(errno));
}

static fm_status move_chart(const char *directory, const char *name, fm_error *err)
{
    char from[FM_PATH_MAX_BYTES], to[FM_PATH_MAX_BYTES];
    fm_status status = chart_path(from, directory, FM_PUBLISH_CHARTS, name, err);
    if (status == FM_OK)
        status = chart_path(to, directory, "charts", name, err);
    return status == FM_OK ? put_in_place(from, to, err) : status;
}

/* The page comes last: while it is the old one, it shows old charts and numbers. */
enum { CLAIMS, TRADEOFF, STABILITY, PAGE, FILES };
static const char *const file_names[FILES] = { "claims.csv", "tradeoff.csv", "stability.csv",
                                               "report.html" };

/* What happens to a file of before. */
typedef enum fate { FATE_REPLACE, FATE_REMOVE, FATE_LEAVE } fate;

typedef struct published {
    fate fate;
    char path[FM_PATH_MAX_BYTES], made[FM_PATH_MAX_BYTES]; /* made: beside it, till all is there */
} published;

/* The text of a file but the claims'; NULL: the file is left alone. */
static const fm_text *text_of(const fm_publish_desc *desc, int file)
{
    return file == TRADEOFF ? desc->tradeoff : file == STABILITY ? desc->stability : desc->page;
}

static fate fate_of(const fm_publish_desc *desc, int file)
{
    if (file == CLAIMS)
        return desc->verdicts == NULL       ? FATE_LEAVE
               : desc->verdicts->count == 0 ? FATE_REMOVE
                                            : FATE_REPLACE;
    return text_of(desc, file) == NULL ? FATE_LEAVE : FATE_REPLACE;
}

static fm_status name_files(published files[FILES], const fm_publish_desc *desc, fm_error *err)
{
    fm_status status = FM_OK;
    for (int i = 0; i < FILES && status == FM_OK; i++) {
        char made[32];
        files[i].fate = fate_of(desc, i);
        snprintf(made, sizeof made, "%s.new", file_names[i]);
        status = path_join(files[i].path, desc->directory, file_names[i], err);
        if (status == FM_OK)
            status = path_join(files[i].made, desc->directory, made, err);
    }
    return status;
}

static fm_status write_files(const published files[FILES], const fm_publish_desc *desc,
                             fm_error *err)
{
    fm_status status = FM_OK;
    for (int i = 0; i < FILES && status == FM_OK; i++) {
        if (files[i].fate != FATE_REPLACE)
            continue;
        const fm_text *text = text_of(desc, i);
        status = i == CLAIMS ? verdicts_write(desc->verdicts, files[i].made, err)
                             : text_write_file(files[i].made, text->bytes, text->length, err);
    }
    return status;
}

static fm_status move_all(const published files[FILES], const char *directory, fm_error *err)
{
    fm_status status = visit_charts(directory, "charts", remove_old, err);
    if (status == FM_OK)
        status = visit_charts(directory, FM_PUBLISH_CHARTS, move_chart, err);
    for (int i = 0; i < FILES && status == FM_OK; i++) {
        if (files[i].fate == FATE_REPLACE)
            status = put_in_place(files[i].made, files[i].path, err);
        else if (files[i].fate == FATE_REMOVE && unlink(files[i].path) != 0 && errno != ENOENT)
            status = fm_fail(err, FM_IO, "%s: %s", files[i].path, strerror(errno));
    }
    return status;
}

fm_status publish_end(const fm_publish_desc *desc, fm_error *err)
{
    published files[FILES];
    fm_status status = make_folder(desc->directory, "charts", err);
    if (status == FM_OK)
        status = name_files(files, desc, err);
    if (status != FM_OK)
        return status;
    status = write_files(files, desc, err);
    if (status == FM_OK)
        status = move_all(files, desc->directory, err);
    for (int i = 0; i < FILES && status != FM_OK; i++)
        unlink(files[i].made);
    return status;
}

void publish_drop(const char *directory)
{
    char path[FM_PATH_MAX_BYTES];
    if (visit_charts(directory, FM_PUBLISH_CHARTS, remove_partial, NULL) == FM_OK &&
        path_join(path, directory, FM_PUBLISH_CHARTS, NULL) == FM_OK)
        rmdir(path);
}
