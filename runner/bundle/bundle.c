#include "bundle.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/data.h"
#include "bundle_methods.h"
#include "bundle_papers.h"
#include "bundle_scenes.h"
#include "child/child.h"
#include "items.h"
#include "libraries.h"
#include "staging.h"

enum { TRIAL_WAIT_S = 120 };

static const char program_name[] = "bin/fragmark";
static const char library_folder[] = "lib/fragmark/lib";

/* A bundle while it is made, in a folder beside where it will be. */
typedef struct making {
    const fm_bundle_desc *desc;
    fm_bundle_result *result;
    char root[FM_PATH_MAX_BYTES], log[FM_PATH_MAX_BYTES]; /* log: beside root */
    char program[FM_PATH_MAX_BYTES];                      /* this one */
    bundle_items items;
    fm_text_list ids, plugins; /* methods, and where they come from */
} making;

static fm_status open_root(making *of, fm_error *err)
{
    fm_status status = staging_expect_free(of->desc->directory, err);
    if (status == FM_OK)
        status = staging_open(of->root, of->desc->directory, err);
    snprintf(of->log, sizeof of->log, "%.*s.log", FM_PATH_MAX_BYTES - 8, of->root);
    return status;
}

static fm_status add_program(making *of, fm_error *err)
{
    const ssize_t length = readlink("/proc/self/exe", of->program, sizeof of->program - 1);
    if (length <= 0 || length >= (ssize_t)sizeof of->program - 1)
        return fm_fail(err, FM_IO, "/proc/self/exe cannot be read");
    of->program[length] = '\0';
    return items_add(&of->items, of->program, program_name, err);
}

static fm_status add_data(making *of, data_kind kind, uint32_t *count, const char *const *endings,
                          fm_error *err)
{
    fm_text_list folders = { 0 };
    fm_status status = data_folders(&folders, kind, err);
    for (size_t i = 0; i < folders.count && status == FM_OK; i++)
        status = items_add_tree(&of->items, count, folders.items[i], data_bundle_folder(kind),
                                endings, err);
    text_list_free(&folders);
    return status;
}

static fm_status add_all_data(making *of, fm_error *err)
{
    static const char *const yaml[] = { ".yml", NULL }, *const results[] = { ".csv", ".json",
                                                                             NULL };
    /* And what no scene names, such as the buffers of a glTF file. */
    static const char *const meshes[] = { ".obj",  ".ply", ".off", ".stl",    ".3ds",
                                          ".gltf", ".glb", ".bin", ".stream", NULL };
    uint32_t ignored = 0;
    fm_status status = add_data(of, DATA_SCENES, &of->result->scenes, yaml, err);
    if (status == FM_OK)
        status = bundle_add_scene_files(&of->items, err);
    if (status == FM_OK)
        status = add_data(of, DATA_SCENES, &ignored, meshes, err);
    if (status == FM_OK)
        status = add_data(of, DATA_FIGURES, &of->result->figures, yaml, err);
    return status == FM_OK ? add_data(of, DATA_REFERENCES, &of->result->references, results, err)
                           : status;
}

static fm_status add_libraries(making *of, fm_error *err)
{
    fm_text_list paths = { 0 }, programs = { 0 };
    char to[FM_PATH_MAX_BYTES];
    fm_status status =
        text_list_add(&programs, of->program) && text_list_add_all(&programs, &of->plugins)
            ? libraries_find(&paths, &programs, of->log, err)
            : fm_fail(err, FM_NO_MEMORY, "no memory for libraries");
    for (size_t i = 0; i < paths.count && status == FM_OK; i++) {
        status = path_join(to, library_folder, strrchr(paths.items[i], '/') + 1, err);
        if (status == FM_OK)
            status = items_add(&of->items, paths.items[i], to, err);
    }
    of->result->libraries = (uint32_t)paths.count;
    text_list_free(&programs);
    text_list_free(&paths);
    return status;
}

/* The bundled program finds each library but glibc's in the bundle. */
static fm_status try_libraries(const making *of, const char *program, fm_error *err)
{
    fm_text_list paths = { 0 }, programs = { 0 };
    unlink(of->log);
    fm_status status = text_list_add(&programs, program)
                           ? libraries_find(&paths, &programs, of->log, err)
                           : fm_fail(err, FM_NO_MEMORY, "no memory for libraries");
    for (size_t i = 0; i < paths.count && status == FM_OK; i++) {
        char real[FM_PATH_MAX_BYTES + 4096];
        const char *top = realpath(of->root, real);
        char *found = realpath(paths.items[i], NULL);
        if (top == NULL || found == NULL || strncmp(found, top, strlen(top)) != 0)
            status = fm_fail(err, FM_IO, "the bundled program would take %s from this machine",
                             paths.items[i]);
        free(found);
    }
    text_list_free(&programs);
    text_list_free(&paths);
    return status;
}

/* It lists its methods, and all of them. */
static fm_status try_methods(const making *of, const char *program, fm_error *err)
{
    static const char *const added[] = { "LD_LIBRARY_PATH=",         "FRAGMARK_PLUGIN_PATH=",
                                         "FRAGMARK_SCENE_PATH=",     "FRAGMARK_FIGURE_PATH=",
                                         "FRAGMARK_REFERENCE_PATH=", NULL };
    const char *const argv[] = { program, "list", "methods", NULL };
    const fm_child_desc desc = {
        .path = program, .argv = (char *const *)(const void *)argv, .added = added, .log = of->log
    };
    pid_t pid = 0;
    int code = -1;
    size_t count = 0;
    char *said = NULL;
    unlink(of->log);
    fm_status status = child_start(&pid, &desc, err);
    if (status == FM_OK && !child_wait(&code, pid, TRIAL_WAIT_S, NULL))
        code = -1;
    if (status == FM_OK)
        status = text_read_file(&said, &count, of->log, 1u << 20, err);
    if (status == FM_OK && code != 0)
        status = fm_fail(err, FM_IO, "the bundled program does not run (%d): %.500s", code, said);
    for (size_t i = 0; i < of->ids.count && status == FM_OK; i++)
        if (strstr(said, of->ids.items[i]) == NULL)
            status =
                fm_fail(err, FM_IO, "the bundled program does not list '%s'", of->ids.items[i]);
    free(said);
    return status;
}

static fm_status try_bundle(const making *of, fm_error *err)
{
    char program[FM_PATH_MAX_BYTES];
    fm_status status = path_join(program, of->root, program_name, err);
    if (status == FM_OK)
        status = try_libraries(of, program, err);
    return status == FM_OK ? try_methods(of, program, err) : status;
}

static fm_status make(making *of, fm_error *err)
{
    fm_status status = open_root(of, err);
    if (status == FM_OK)
        status = add_program(of, err);
    if (status == FM_OK)
        status = bundle_add_methods(&of->items, &of->ids, &of->plugins, of->desc, err);
    if (status == FM_OK)
        status = add_all_data(of, err);
    if (status == FM_OK)
        status = add_libraries(of, err);
    if (status == FM_OK)
        status = staging_expect_room(of->root, items_bytes(&of->items), "a bundle", err);
    if (status == FM_OK)
        status = items_copy(&of->items, of->root, err);
    if (status == FM_OK)
        status = bundle_write_papers(of->root, &of->items, &of->ids, err);
    if (status == FM_OK)
        status = try_bundle(of, err);
    if (status == FM_OK && rename(of->root, of->desc->directory) != 0)
        status = fm_fail(err, FM_IO, "%s: %s", of->desc->directory, strerror(errno));
    return status;
}

fm_status bundle_make(fm_bundle_result *result, const fm_bundle_desc *desc, fm_error *err)
{
    making of = { .desc = desc, .result = result };
    *result = (fm_bundle_result){ 0 };
    const fm_status status = make(&of, err);
    result->methods = (uint32_t)of.ids.count;
    result->bytes = items_bytes(&of.items);
    if (of.root[0] != '\0')
        unlink(of.log);
    if (of.root[0] != '\0' && status != FM_OK)
        tree_remove(of.root);
    items_free(&of.items);
    text_list_free(&of.ids);
    text_list_free(&of.plugins);
    return status;
}
