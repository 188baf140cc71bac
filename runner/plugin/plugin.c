#include "plugin.h"

#include <dlfcn.h>
#include <errno.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "code/shader_files.h"

bool plugin_has_k(const fm_method_desc *method)
{
    return method->keeps == FM_KEEPS_K_NEAREST || method->keeps == FM_KEEPS_ALL_IN_K;
}

/* The part behind the last slash. */
static const char *file_of(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash == NULL ? path : slash + 1;
}

/* path with a slash, so that dlopen takes it as it is and searches nowhere. */
static fm_status set_paths(fm_plugin *plugin, const char *path, fm_error *err)
{
    const char *prefix = strchr(path, '/') == NULL ? "./" : "";
    const int length = snprintf(plugin->path, sizeof plugin->path, "%s%s", prefix, path);
    if (length < 0 || (size_t)length >= sizeof plugin->path)
        return fm_fail(err, FM_INVALID, "%s: path too long", path);
    const int folder_length = (int)(strrchr(plugin->path, '/') - plugin->path);
    if (folder_length > 0)
        snprintf(plugin->folder, sizeof plugin->folder, "%.*s", folder_length, plugin->path);
    else
        snprintf(plugin->folder, sizeof plugin->folder, "/.");
    return FM_OK;
}

/* abi and size_bytes come first: a descriptor of another ABI may end before the other fields. */
static fm_status load(fm_plugin *plugin, fm_error *err)
{
    const char *name = file_of(plugin->path);
    if (access(plugin->path, R_OK) != 0)
        return fm_fail(err, FM_IO, "%s: %s", plugin->path, strerror(errno));
    plugin->handle = dlopen(plugin->path, RTLD_NOW | RTLD_LOCAL);
    if (plugin->handle == NULL)
        return fm_fail(err, FM_INVALID, "%s: cannot be loaded: %s", name, dlerror());
    plugin->method = dlsym(plugin->handle, "fm_method");
    if (plugin->method == NULL)
        return fm_fail(
            err, FM_INVALID,
            "%s: no symbol 'fm_method': a plugin defines `const fm_method_desc fm_method`", name);
    return plugin_check(plugin->method, name, err);
}

static fm_status check_file_name(const fm_plugin *plugin, fm_error *err)
{
    char expected[80];
    const char *name = file_of(plugin->path);
    snprintf(expected, sizeof expected, "%s.so", plugin->method->id);
    if (strcmp(name, expected) != 0)
        return fm_fail(err, FM_INVALID, "%s: id: '%s': the file must be named '%s'", name,
                       plugin->method->id, expected);
    return FM_OK;
}

/* "common/x.glsl" is the runner's, and as right as the runner. */
static fm_status check_shader_files(const fm_plugin *plugin, const char *common, fm_error *err)
{
    const fm_shader_folders folders = { .method = plugin->folder, .common = common };
    char path[FM_PATH_MAX_BYTES];
    for (size_t i = 0; i < FM_MAX_PASSES && plugin->method->passes[i].name != NULL; i++) {
        const fm_pass *pass = &plugin->method->passes[i];
        if (pass->shader == NULL || strncmp(pass->shader, "common/", 7) == 0)
            continue;
        if (shader_file_find(path, &folders, pass->shader, err) != FM_OK)
            return fm_error_prefix(err, "%s: pass '%s': shader", file_of(plugin->path), pass->name);
        if (access(path, R_OK) != 0)
            return fm_fail(err, FM_INVALID, "%s: pass '%s': shader '%s': cannot read %s",
                           file_of(plugin->path), pass->name, pass->shader, path);
    }
    return FM_OK;
}

fm_status plugin_open(fm_plugin **plugin, const char *path, const char *common, fm_error *err)
{
    *plugin = NULL;
    fm_plugin *made = calloc(1, sizeof *made);
    if (made == NULL)
        return fm_fail(err, FM_NO_MEMORY, "%s: %zu bytes", path, sizeof *made);
    fm_status status = set_paths(made, path, err);
    if (status == FM_OK)
        status = load(made, err);
    if (status == FM_OK)
        status = check_file_name(made, err);
    if (status == FM_OK)
        status = check_shader_files(made, common, err);
    if (status != FM_OK) {
        plugin_close(made);
        return status;
    }
    *plugin = made;
    return FM_OK;
}

void plugin_close(fm_plugin *plugin)
{
    if (plugin == NULL)
        return;
    if (plugin->handle != NULL)
        dlclose(plugin->handle);
    free(plugin);
}
