#include "agree.h"

#include <assert.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "code/code_json.h"

/* What was read by whom first: "program", or "METHOD method store.glsl", with its hash. */
typedef struct code_book {
    fm_text_index names;
    struct entry {
        uint64_t hash;
        size_t folder;
    } * entries;
    size_t count, room;
} code_book;

static fm_status no_memory(fm_error *err)
{
    return fm_fail(err, FM_NO_MEMORY, "no memory for the shards' codes");
}

static fm_status add_entry(code_book *book, const char *name, uint64_t hash, size_t folder,
                           fm_error *err)
{
    if (text_index_add(&book->names, name, book->count) == FM_TEXT_INDEX_NONE)
        return no_memory(err);
    if (book->count == book->room) {
        const size_t room = book->room > 0 ? 2 * book->room : 64;
        struct entry *grown = reallocarray(book->entries, room, sizeof *grown);
        if (grown == NULL)
            return no_memory(err);
        book->entries = grown;
        book->room = room;
    }
    assert(book->entries != NULL);
    book->entries[book->count++] = (struct entry){ hash, folder };
    return FM_OK;
}

static fm_status check_entry(code_book *book, const shard_set *set, const char *name, uint64_t hash,
                             size_t folder, fm_error *err)
{
    const size_t at = text_index_find(&book->names, name);
    if (at == FM_TEXT_INDEX_NONE)
        return add_entry(book, name, hash, folder, err);
    assert(book->entries != NULL);
    if (book->entries[at].hash == hash)
        return FM_OK;
    const shard_folder *a = &set->folders[book->entries[at].folder], *b = &set->folders[folder];
    return fm_fail(err, FM_UNSUPPORTED,
                   "%s (%u/%u) and %s (%u/%u) were measured by other code: %s differs; shards are "
                   "merged only of one program, plugins and GLSL",
                   a->path, a->index, a->count, b->path, b->index, b->count, name);
}

/* The method whose plugin the code has; "": none was read. */
static void find_method(char *method, size_t room, const fm_code *code)
{
    method[0] = '\0';
    for (size_t i = 0; i < code->count; i++) {
        const char *name = code->files[i].name, *dot = strrchr(name, '.');
        if (code->files[i].owner == FM_CODE_OF_METHOD && code_file_is_plugin(&code->files[i]))
            snprintf(method, room, "%.*s", (int)(dot - name), name);
    }
}

static fm_status check_code(code_book *book, const shard_set *set, const fm_code *code,
                            size_t folder, fm_error *err)
{
    char method[128], name[512];
    fm_status status = FM_OK;
    find_method(method, sizeof method, code);
    if (code->program != 0)
        status = check_entry(book, set, "the program", code->program, folder, err);
    for (size_t i = 0; i < code->count && status == FM_OK; i++) {
        const fm_code_file *file = &code->files[i];
        snprintf(name, sizeof name, "%s of %s%s", file->name,
                 file->owner == FM_CODE_OF_FLOOR ? "the floor of " : "", method);
        status = check_entry(book, set, name, file->hash, folder, err);
    }
    return status;
}

static fm_status check_codes(code_book *book, const shard_set *set, size_t folder, bool *is_damaged,
                             fm_error *err)
{
    const json_t *codes = json_object_get(set->folders[folder].manifest, "codes"), *json;
    size_t i;
    fm_status status = FM_OK;
    *is_damaged = !json_is_array(codes);
    json_array_foreach(codes, i, json)
    {
        fm_code code;
        const bool is_code = code_from_json(&code, json);
        *is_damaged = *is_damaged || !is_code;
        if (is_code && status == FM_OK)
            status = check_code(book, set, &code, folder, err);
        code_free(&code);
    }
    return *is_damaged ? fm_fail(err, FM_INVALID, "%s/manifest.json: damaged: codes cannot be",
                                 set->folders[folder].path)
                       : status;
}

/* Texts and flags that all manifests must have alike. */
static fm_status check_manifest(const shard_set *set, size_t folder, fm_error *err)
{
    static const struct {
        const char *name;
        fm_status status;
    } facts[] = { { "fragmark", FM_UNSUPPORTED },
                  { "validation", FM_INVALID },
                  { "no_timers", FM_INVALID },
                  { "figures", FM_INVALID } };
    const shard_folder *a = &set->folders[0], *b = &set->folders[folder];
    for (size_t i = 0; i < sizeof facts / sizeof facts[0]; i++)
        if (!json_equal(json_object_get(a->manifest, facts[i].name),
                        json_object_get(b->manifest, facts[i].name)))
            return fm_fail(err, facts[i].status, "%s and %s: '%s' differs in their manifest.json",
                           a->path, b->path, facts[i].name);
    return FM_OK;
}

static fm_status check_columns(const shard_set *set, size_t folder, fm_error *err)
{
    const fm_table *a = set->folders[0].summary, *b = set->folders[folder].summary;
    bool is_same = a->column_count == b->column_count;
    for (size_t i = 0; i < a->column_count && is_same; i++)
        is_same = strcmp(a->names[i], b->names[i]) == 0;
    return is_same ? FM_OK
                   : fm_fail(err, FM_UNSUPPORTED, "%s and %s have other columns", a->path, b->path);
}

fm_status agree_check(const shard_set *set, bool *is_damaged, fm_error *err)
{
    code_book book = { .entries = NULL };
    fm_status status = FM_OK;
    *is_damaged = false;
    for (size_t i = 0; i < set->count && status == FM_OK; i++) {
        status = check_manifest(set, i, err);
        if (status == FM_OK)
            status = check_codes(&book, set, i, is_damaged, err);
        if (status == FM_OK)
            status = check_columns(set, i, err);
    }
    text_index_free(&book.names);
    free(book.entries);
    return status;
}
