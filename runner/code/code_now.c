#include "code_now.h"

#include <dirent.h>
#include <stdio.h>
#include <string.h>

#include "shader_files.h"

/* The folder that a plugin lies in; "" for none. */
static void folder_of(char folder[FM_PATH_MAX_BYTES], const char *plugin)
{
    const char *slash = strrchr(plugin, '/');
    const int length = slash != NULL ? (int)(slash - plugin) : 0;
    snprintf(folder, FM_PATH_MAX_BYTES, "%.*s", length, plugin);
}

static uint64_t hash_now(const fm_code_file *file, const fm_code_places *places)
{
    char folder[FM_PATH_MAX_BYTES], path[FM_PATH_MAX_BYTES];
    const char *plugin = places->plugins[file->owner];
    folder_of(folder, plugin);
    const fm_shader_folders folders = { .method = folder, .common = places->common };
    const fm_status status = code_file_is_plugin(file)
                                 ? path_join(path, folder, file->name, NULL)
                                 : shader_file_find(path, &folders, file->name, NULL);
    return status == FM_OK ? code_hash_file(path) : 0;
}

void code_look_again(fm_code *now, const fm_code *then, const fm_code_places *places)
{
    now->program = places->program;
    now->driver = places->driver;
    for (size_t i = 0; i < then->count; i++) {
        const fm_code_file *file = &then->files[i];
        code_add(now, file->owner, file->name, hash_now(file, places));
    }
}

static bool is_glsl(const char *name)
{
    const char *dot = strrchr(name, '.');
    return dot != NULL && strcmp(dot, ".glsl") == 0;
}

/* All GLSL of a folder, by names that begin with `prefix`. */
static void add_folder(fm_code *code, fm_code_owner owner, const char *folder, const char *prefix)
{
    char path[FM_PATH_MAX_BYTES], name[300];
    DIR *open = folder[0] != '\0' ? opendir(folder) : NULL;
    for (struct dirent *entry; open != NULL && (entry = readdir(open)) != NULL;) {
        snprintf(name, sizeof name, "%s%s", prefix, entry->d_name);
        if (is_glsl(name) && path_join(path, folder, entry->d_name, NULL) == FM_OK)
            code_add(code, owner, name, code_hash_file(path));
    }
    if (open != NULL)
        closedir(open);
}

void code_guess(fm_code *code, const fm_code_places *places, const char *const *shaders)
{
    char folder[FM_PATH_MAX_BYTES];
    code->program = places->program;
    code->driver = places->driver;
    add_folder(code, FM_CODE_OF_METHOD, places->common, "common/");
    for (int i = 0; i < FM_CODE_OWNER_COUNT; i++) {
        const fm_code_owner owner = (fm_code_owner)i;
        if (places->plugins[owner][0] == '\0')
            continue;
        code_add_plugin(code, owner, places->plugins[owner]);
        folder_of(folder, places->plugins[owner]);
        add_folder(code, owner, folder, "");
    }
    for (; *shaders != NULL; shaders++) {
        const fm_code_file file = { .owner = FM_CODE_OF_METHOD, .name = *shaders };
        if (strchr(*shaders, '/') != NULL && strncmp(*shaders, "common/", 7) != 0)
            code_add(code, file.owner, file.name, hash_now(&file, places));
    }
}
