#include "kept_cases.h"

#include <dirent.h>
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/csv.h"

enum { SUMMARY_MOST_BYTES = 256 << 20, LISTED_MOST = 8, COLUMNS_MOST = 256 };

const char *const kept_facts[KEPT_FACT_COUNT] = {
    [KEPT_CASE_ID] = "case_id",
    [KEPT_STATUS] = "status",
    [KEPT_METHOD] = "method",
    [KEPT_DEVICE] = "device",
    [KEPT_FEED] = "feed",
    [KEPT_SCENE] = "scene",
    [KEPT_N] = "n",
    [KEPT_K] = "k",
    [KEPT_SEED] = "seed",
    [KEPT_OPTIONS] = "options",
};

static bool set_fact(kept_case *of, kept_fact fact, const char *text, size_t length)
{
    char *copy = strndup(text, length);
    if (copy == NULL)
        return false;
    free(of->facts[fact]);
    of->facts[fact] = copy;
    return true;
}

static void free_case(kept_case *of)
{
    for (int fact = 0; fact < KEPT_FACT_COUNT; fact++)
        free(of->facts[fact]);
}

static bool has_room(kept_cases *cases)
{
    if (cases->count < cases->capacity)
        return true;
    const size_t capacity = cases->capacity > 0 ? 2 * cases->capacity : 16;
    kept_case *more = realloc(cases->cases, capacity * sizeof *more);
    if (more == NULL)
        return false;
    cases->cases = more;
    cases->capacity = capacity;
    return true;
}

/* The case of this id, which is a new one if it was not there; NULL: no memory. */
static kept_case *add_case(kept_cases *cases, const char *id, size_t length)
{
    kept_case added = { .kinds = 0 };
    if (!has_room(cases))
        return NULL;
    for (int i = 0; i < KEPT_FACT_COUNT; i++)
        if (!set_fact(&added, (kept_fact)i, id, i == KEPT_CASE_ID ? length : 0))
            goto out;
    const size_t at = text_index_add(&cases->ids, added.facts[KEPT_CASE_ID], cases->count);
    if (at == FM_TEXT_INDEX_NONE)
        goto out;
    if (at == cases->count) {
        cases->cases[cases->count++] = added;
        return &cases->cases[at];
    }
    free_case(&added);
    return &cases->cases[at];
out:
    free_case(&added);
    return NULL;
}

/* "ID.fragments"; others, such as what a killed run left half written, are nobody's. */
static bool add_file(kept_cases *cases, const char *name)
{
    const char *dot = strrchr(name, '.');
    for (int kind = 0; dot != NULL && dot > name && kind < KEPT_KIND_COUNT; kind++) {
        if (strcmp(dot + 1, kept_names[kind]) != 0)
            continue;
        kept_case *of = add_case(cases, name, (size_t)(dot - name));
        if (of == NULL)
            return false;
        of->kinds |= 1u << kind;
    }
    return true;
}

static int by_id(const void *a, const void *b)
{
    const kept_case *left = a, *right = b;
    return strcmp(left->facts[KEPT_CASE_ID], right->facts[KEPT_CASE_ID]);
}

static fm_status read_folder(kept_cases *cases, const char *path, fm_error *err)
{
    DIR *folder = opendir(path);
    const struct dirent *entry;
    bool is_added = true;
    if (folder == NULL && errno == ENOENT)
        return fm_fail(err, FM_INVALID,
                       "%s: not there: nothing was kept; `fragmark run --keep "
                       "fragments,truth,frames` keeps",
                       path);
    if (folder == NULL)
        return fm_fail(err, FM_IO, "%s: %s", path, strerror(errno));
    while (is_added && (entry = readdir(folder)) != NULL)
        is_added = add_file(cases, entry->d_name);
    closedir(folder);
    if (!is_added)
        return fm_fail(err, FM_NO_MEMORY, "%s: no memory for its files", path);
    if (cases->count == 0)
        return fm_fail(err, FM_INVALID, "%s: nothing is kept in it", path);
    return FM_OK;
}

/* Which column each fact stands in; COLUMNS_MOST: in none. */
static void find_columns(size_t columns[KEPT_FACT_COUNT], char *line)
{
    for (int i = 0; i < KEPT_FACT_COUNT; i++)
        columns[i] = COLUMNS_MOST;
    for (size_t column = 0; *line != '\0' && column < COLUMNS_MOST; column++) {
        const char *name = csv_take_field(&line);
        for (int i = 0; i < KEPT_FACT_COUNT; i++)
            if (strcmp(name, kept_facts[i]) == 0)
                columns[i] = column;
    }
}

static bool add_row(kept_cases *cases, const size_t columns[KEPT_FACT_COUNT], char *line)
{
    const char *fields[COLUMNS_MOST + 1];
    for (size_t i = 0; i < COLUMNS_MOST; i++)
        fields[i] = *line != '\0' ? csv_take_field(&line) : "";
    fields[COLUMNS_MOST] = "";
    const size_t at = text_index_find(&cases->ids, fields[columns[KEPT_CASE_ID]]);
    bool is_set = true;
    for (int fact = 0; at != FM_TEXT_INDEX_NONE && is_set && fact < KEPT_FACT_COUNT; fact++) {
        const char *text = fields[columns[fact]];
        is_set = set_fact(&cases->cases[at], (kept_fact)fact, text, strlen(text));
    }
    return is_set;
}

static fm_status read_summary(kept_cases *cases, const char *path, fm_error *err)
{
    char *bytes = NULL;
    size_t count = 0, columns[KEPT_FACT_COUNT];
    bool is_first = true, is_added = true;
    if (access(path, F_OK) != 0 && errno == ENOENT)
        return FM_OK;
    const fm_status status = text_read_file(&bytes, &count, path, SUMMARY_MOST_BYTES, err);
    if (status != FM_OK)
        return status;
    for (char *line = bytes, *end; is_added && *line != '\0'; line = end) {
        end = csv_line_end(line);
        if (*end == '\n')
            *end++ = '\0';
        if (is_first)
            find_columns(columns, line);
        else
            is_added = add_row(cases, columns, line);
        is_first = false;
    }
    free(bytes);
    return is_added ? FM_OK : fm_fail(err, FM_NO_MEMORY, "%s: no memory for its rows", path);
}

fm_status kept_cases_read(kept_cases *cases, const char *directory, fm_error *err)
{
    char path[FM_PATH_MAX_BYTES];
    fm_status status = path_is_folder(directory, err);
    if (status == FM_OK)
        status = path_join(path, directory, "kept", err);
    if (status == FM_OK)
        status = read_folder(cases, path, err);
    if (status == FM_OK)
        status = path_join(path, directory, "summary.csv", err);
    if (status == FM_OK)
        status = read_summary(cases, path, err);
    if (status == FM_OK)
        qsort(cases->cases, cases->count, sizeof *cases->cases, by_id);
    text_index_free(&cases->ids);
    return status;
}

void kept_cases_free(kept_cases *cases)
{
    for (size_t i = 0; i < cases->count; i++)
        free_case(&cases->cases[i]);
    free(cases->cases);
    *cases = (kept_cases){ 0 };
}

static bool fits(const kept_case *of, const char *const wanted[KEPT_FACT_COUNT], int facts)
{
    for (int i = 0; i < facts; i++)
        if (wanted[i] != NULL && wanted[i][0] != '\0' && strcmp(wanted[i], of->facts[i]) != 0)
            return false;
    return true;
}

/* The first fact that no case has together with those before it. */
static fm_status refuse(const kept_cases *cases, const char *const wanted[KEPT_FACT_COUNT],
                        fm_error *err)
{
    const char **names = calloc(cases->count, sizeof *names);
    size_t count = 0;
    int fact = 0;
    if (names == NULL)
        return fm_fail(err, FM_NO_MEMORY, "no memory for %zu cases", cases->count);
    for (bool is_met = true; is_met; fact += is_met) {
        is_met = false;
        for (size_t i = 0; i < cases->count; i++)
            is_met = is_met || fits(&cases->cases[i], wanted, fact + 1);
    }
    for (size_t i = 0; i < cases->count; i++)
        if (fits(&cases->cases[i], wanted, fact))
            names[count++] = cases->cases[i].facts[fact];
    const char *nearest = text_nearest(wanted[fact], names, count);
    const fm_status status = fm_fail(
        err, FM_INVALID, "no kept case has %s '%.80s'; %s '%.80s'", kept_facts[fact], wanted[fact],
        nearest != NULL ? "the nearest is" : "there is", nearest != NULL ? nearest : names[0]);
    free(names);
    return status;
}

static fm_status list_several(const kept_cases *cases, const char *const wanted[KEPT_FACT_COUNT],
                              size_t count, fm_error *err)
{
    fm_text text = { 0 };
    size_t listed = 0;
    for (size_t i = 0; i < cases->count && listed < LISTED_MOST; i++) {
        char *const *facts = cases->cases[i].facts;
        if (!fits(&cases->cases[i], wanted, KEPT_FACT_COUNT))
            continue;
        text_add(&text, "\n  --case %s  %s %s %s %s%s%sseed=%s %s", facts[KEPT_CASE_ID],
                 facts[KEPT_METHOD], facts[KEPT_FEED], facts[KEPT_SCENE],
                 facts[KEPT_K][0] != '\0' ? "k=" : "", facts[KEPT_K],
                 facts[KEPT_K][0] != '\0' ? " " : "", facts[KEPT_SEED], facts[KEPT_OPTIONS]);
        listed++;
    }
    const fm_status status =
        fm_fail(err, FM_INVALID, "%zu kept cases fit: which one?%.1500s%s", count,
                text.bytes != NULL ? text.bytes : "",
                count > LISTED_MOST ? "\n  ...: `fragmark dump DIR` lists all" : "");
    text_free(&text);
    return status;
}

fm_status kept_cases_choose(const kept_case **chosen, const kept_cases *cases,
                            const char *const wanted[KEPT_FACT_COUNT], fm_error *err)
{
    size_t count = 0;
    *chosen = NULL;
    for (size_t i = 0; i < cases->count; i++) {
        if (!fits(&cases->cases[i], wanted, KEPT_FACT_COUNT))
            continue;
        *chosen = &cases->cases[i];
        count++;
    }
    if (count == 1)
        return FM_OK;
    return count == 0 ? refuse(cases, wanted, err) : list_several(cases, wanted, count, err);
}

static fm_status open_kind(kept_files *files, kept_kind kind, const char *path, fm_error *err)
{
    kept_map *map = &files->maps[kind];
    fm_status status = kept_open(map, path, err);
    files->is_damaged = map->is_damaged;
    if (status == FM_OK && map->header->kind != (uint32_t)kind) {
        files->is_damaged = true;
        status =
            fm_fail(err, FM_IO, "%s: damaged: it holds %s", path, kept_names[map->header->kind]);
    }
    files->files[kind] = status == FM_OK ? map : NULL;
    return status;
}

fm_status kept_files_open(kept_files *files, const char *directory, const kept_case *of,
                          fm_error *err)
{
    char path[FM_PATH_MAX_BYTES], name[FM_PATH_MAX_BYTES];
    fm_status status = FM_OK;
    for (int kind = 0; kind < KEPT_KIND_COUNT && status == FM_OK; kind++) {
        if ((of->kinds & 1u << kind) == 0)
            continue;
        snprintf(name, sizeof name, "kept/%.500s.%s", of->facts[KEPT_CASE_ID], kept_names[kind]);
        status = path_join(path, directory, name, err);
        if (status == FM_OK)
            status = open_kind(files, (kept_kind)kind, path, err);
    }
    const kept_map *fragments = files->files[KEPT_FRAGMENTS], *truth = files->files[KEPT_TRUTH];
    if (status == FM_OK && fragments != NULL && truth != NULL &&
        (fragments->header->width_px != truth->header->width_px ||
         fragments->header->height_px != truth->header->height_px)) {
        files->is_damaged = true;
        status = fm_fail(err, FM_IO,
                         "%.80s: damaged: its fragments and its truth are of pictures of different "
                         "sizes",
                         of->facts[KEPT_CASE_ID]);
    }
    return status;
}

fm_status kept_files_open_one(kept_files *files, const char *path, fm_error *err)
{
    kept_map map;
    const fm_status status = kept_open(&map, path, err);
    files->is_damaged = map.is_damaged;
    if (status != FM_OK)
        return status;
    files->maps[map.header->kind] = map;
    files->files[map.header->kind] = &files->maps[map.header->kind];
    return FM_OK;
}

void kept_files_close(kept_files *files)
{
    for (int kind = 0; kind < KEPT_KIND_COUNT; kind++)
        kept_close(&files->maps[kind]);
    *files = (kept_files){ .is_damaged = files->is_damaged };
}
