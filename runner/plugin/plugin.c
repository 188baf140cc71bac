#include "plugin.h"

#include <dlfcn.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "shader_files.h"

bool plugin_has_k(const fm_method_desc *method)
{
    return method->keeps == FM_KEEPS_K_NEAREST || method->keeps == FM_KEEPS_ALL_IN_K;
}

const char *plugin_file_name(const char *path)
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

static fm_status make(fm_plugin **plugin, const char *path, fm_error *err)
{
    *plugin = NULL;
    fm_plugin *made = calloc(1, sizeof *made);
    if (made == NULL)
        return fm_fail(err, FM_NO_MEMORY, "%s: %zu bytes", path, sizeof *made);
    const fm_status status = set_paths(made, path, err);
    if (status == FM_OK)
        *plugin = made;
    else
        free(made);
    return status;
}

/* dlopen would wait for whoever writes to a pipe. */
static fm_status expect_file(const char *path, fm_error *err)
{
    struct stat info;
    if (stat(path, &info) != 0 || access(path, R_OK) != 0)
        return fm_fail(err, FM_IO, "%s: %s", path, strerror(errno));
    if (!S_ISREG(info.st_mode))
        return fm_fail(err, FM_INVALID, "%s: cannot be loaded: it is %s, not a file",
                       plugin_file_name(path),
                       S_ISDIR(info.st_mode)    ? "a folder"
                       : S_ISFIFO(info.st_mode) ? "a pipe"
                                                : "a device or a socket");
    return FM_OK;
}

static fm_status load(fm_plugin *plugin, fm_error *err)
{
    const char *name = plugin_file_name(plugin->path);
    const fm_status status = expect_file(plugin->path, err);
    if (status != FM_OK)
        return status;
    plugin->handle = dlopen(plugin->path, RTLD_NOW | RTLD_LOCAL);
    if (plugin->handle == NULL)
        return fm_fail(err, FM_INVALID, "%s: cannot be loaded: %s", name, dlerror());
    plugin->method = dlsym(plugin->handle, "fm_method");
    if (plugin->method == NULL)
        return fm_fail(
            err, FM_INVALID,
            "%s: no symbol 'fm_method': a plugin defines `const fm_method_desc fm_method`", name);
    return FM_OK;
}

fm_status plugin_load(fm_plugin **plugin, const char *path, fm_error *err)
{
    fm_status status = make(plugin, path, err);
    if (status != FM_OK)
        return status;
    status = load(*plugin, err);
    if (status != FM_OK) {
        plugin_close(*plugin);
        *plugin = NULL;
    }
    return status;
}

fm_status plugin_adopt(fm_plugin **plugin, const char *path, const fm_method_desc *method,
                       void *description, fm_error *err)
{
    const fm_status status = make(plugin, path, err);
    if (status != FM_OK)
        return status;
    (*plugin)->method = method;
    (*plugin)->description = description;
    return FM_OK;
}

static fm_status check_file_name(const fm_plugin *plugin, fm_error *err)
{
    char expected[80];
    const char *name = plugin_file_name(plugin->path);
    snprintf(expected, sizeof expected, "%s.so", plugin->method->id);
    if (strcmp(name, expected) != 0)
        return fm_fail(err, FM_INVALID, "%s: id: '%s': the file must be named '%s'", name,
                       plugin->method->id, expected);
    return FM_OK;
}

/* "common/x.glsl" is the runner's, and as right as the runner. */
static fm_status check_shader_files(const fm_plugin *plugin, const char *common, fm_error *err)
{
    const fm_shader_folders folders = { plugin->folder, common };
    const char *name = plugin_file_name(plugin->path);
    char path[FM_PATH_MAX_BYTES];
    for (size_t i = 0; i < FM_MAX_PASSES && plugin->method->passes[i].name != NULL; i++) {
        const fm_pass *pass = &plugin->method->passes[i];
        if (pass->shader == NULL || strncmp(pass->shader, "common/", 7) == 0)
            continue;
        if (shader_file_find(path, &folders, pass->shader, err) != FM_OK)
            return fm_error_prefix(err, "%s: pass '%s': shader", name, pass->name);
        if (access(path, R_OK) != 0)
            return fm_fail(err, FM_INVALID, "%s: pass '%s': shader '%s': cannot read %s", name,
                           pass->name, pass->shader, path);
    }
    return FM_OK;
}

fm_status plugin_check_files(const fm_plugin *plugin, const char *common, fm_error *err)
{
    const fm_status status = check_file_name(plugin, err);
    return status == FM_OK ? check_shader_files(plugin, common, err) : status;
}

fm_status plugin_open(fm_plugin **plugin, const char *path, const char *common, fm_error *err)
{
    fm_plugin *made = NULL;
    *plugin = NULL;
    fm_status status = plugin_load(&made, path, err);
    if (status == FM_OK)
        status = plugin_check(made->method, plugin_file_name(made->path), err);
    if (status == FM_OK)
        status = plugin_check_files(made, common, err);
    if (status == FM_OK)
        *plugin = made;
    else
        plugin_close(made);
    return status;
}

void plugin_close(fm_plugin *plugin)
{
    if (plugin == NULL)
        return;
    if (plugin->handle != NULL)
        dlclose(plugin->handle);
    free(plugin->description);
    free(plugin);
}
