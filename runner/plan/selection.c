#include "selection.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/path.h"
#include "base/yaml_tree.h"
#include "scene/scene_file.h"

/* What the lists are called after -a, in a spec, and on the command line. */
static const struct {
    const char *axis, *list, *option;
} listed_name[] = {
    [FM_LISTED_METHODS] = { "method", "methods", "--method" },
    [FM_LISTED_SCENES] = { "scene", "scenes", "--scene" },
    [FM_LISTED_DEVICES] = { "device", "devices", "--device" },
    [FM_LISTED_FEEDS] = { "feed", "feeds", "--feed" },
};
_Static_assert(sizeof listed_name / sizeof listed_name[0] == FM_LISTED_COUNT, "one row a list");

static fm_listed listed_find(const char *name)
{
    for (fm_listed i = 0; i < FM_LISTED_COUNT; i++)
        if (strcmp(listed_name[i].axis, name) == 0 || strcmp(listed_name[i].list, name) == 0)
            return i;
    return FM_LISTED_COUNT;
}

const char *selection_nearest(const char *name)
{
    const char *names[FM_LISTED_COUNT + 1];
    for (size_t i = 0; i < FM_LISTED_COUNT; i++)
        names[i] = listed_name[i].list;
    names[FM_LISTED_COUNT] = key_nearest(name);
    return text_nearest(name, names, FM_LISTED_COUNT + (names[FM_LISTED_COUNT] != NULL ? 1 : 0));
}

const fm_sweep *selection_find(const fm_selection *selection, const char *name)
{
    for (size_t i = 0; i < selection->sweep_count; i++)
        if (strcmp(selection->sweeps[i].name, name) == 0)
            return &selection->sweeps[i];
    return NULL;
}

/* n and r say the same thing twice: whoever gives one replaces both. */
static const char *rival(const char *name)
{
    return strcmp(name, "n") == 0 ? "r" : strcmp(name, "r") == 0 ? "n" : name;
}

static fm_status add_name(fm_selection *selection, fm_listed list, const char *name,
                          const char *origin, fm_error *err)
{
    if (name[0] == '\0')
        return fm_fail(err, FM_INVALID, "%s: an empty name", origin);
    if (text_list_has(&selection->names[list], name))
        return FM_OK;
    if (!text_list_add(&selection->names[list], name) ||
        !text_list_add(&selection->origins[list], origin))
        return fm_fail(err, FM_NO_MEMORY, "%s: no memory", origin);
    return FM_OK;
}

static fm_status add_names(fm_selection *selection, fm_listed list, const char *names,
                           const char *origin, fm_error *err)
{
    fm_status status = FM_OK;
    char *copy = strdup(names), *rest = copy;
    if (copy == NULL)
        return fm_fail(err, FM_NO_MEMORY, "%s: no memory", origin);
    for (char *item; status == FM_OK && (item = strsep(&rest, ",")) != NULL;)
        status = add_name(selection, list, item, origin, err);
    free(copy);
    return status;
}

/* Takes the sweep over, or destroys it. */
static fm_status keep_sweep(fm_selection *selection, fm_sweep *sweep, fm_error *err)
{
    fm_status status = FM_OK;
    if (selection_find(selection, sweep->name) != NULL)
        status = fm_fail(err, FM_INVALID, "%s: '%s' is given twice", sweep->origin, sweep->name);
    else if (selection_find(selection, rival(sweep->name)) != NULL)
        status = fm_fail(err, FM_INVALID, "%s: n and r: give one of them", sweep->origin);
    else if (sweep->values.count == 0)
        status = fm_fail(err, FM_INVALID, "%s: '%s' has no value", sweep->origin, sweep->name);
    else if (selection->sweep_count == FM_MAX_SWEEPS)
        status = fm_fail(err, FM_INVALID, "%s: more than %d axes", sweep->origin, FM_MAX_SWEEPS);
    if (status == FM_OK)
        selection->sweeps[selection->sweep_count++] = *sweep;
    else
        sweep_destroy(sweep);
    return status;
}

static fm_status read_axis(fm_selection *selection, const char *axis, fm_error *err)
{
    fm_sweep sweep = { 0 };
    char origin[FM_TEXT_MAX], name[sizeof sweep.name];
    const char *equals = strchr(axis, '=');
    snprintf(origin, sizeof origin, "-a %.200s", axis);
    if (equals == NULL || equals == axis)
        return fm_fail(err, FM_INVALID, "%s: not KEY=VALUES", origin);
    if ((size_t)(equals - axis) >= sizeof name)
        return fm_fail(err, FM_INVALID, "%s: no key is that long", origin);
    memcpy(name, axis, (size_t)(equals - axis));
    name[equals - axis] = '\0';
    const fm_listed list = listed_find(name);
    if (list != FM_LISTED_COUNT)
        return add_names(selection, list, equals + 1, origin, err);
    fm_status status = sweep_create(&sweep, name, origin, err);
    if (status == FM_OK)
        status = sweep_add(&sweep, equals + 1, err);
    if (status == FM_OK)
        return keep_sweep(selection, &sweep, err);
    sweep_destroy(&sweep);
    return status;
}

static fm_status read_command_line(fm_selection *selection, const fm_plan_request *request,
                                   fm_error *err)
{
    const char *const *const lists[] = {
        [FM_LISTED_METHODS] = request->methods,
        [FM_LISTED_SCENES] = request->scenes,
        [FM_LISTED_DEVICES] = request->devices,
        [FM_LISTED_FEEDS] = request->feeds,
    };
    fm_status status = FM_OK;
    for (fm_listed i = 0; i < FM_LISTED_COUNT; i++)
        for (const char *const *name = lists[i]; name != NULL && *name != NULL; name++)
            if ((status = add_name(selection, i, *name, listed_name[i].option, err)) != FM_OK)
                return status;
    for (const char *const *axis = request->axes; axis != NULL && *axis != NULL; axis++)
        if ((status = read_axis(selection, *axis, err)) != FM_OK)
            return status;
    return FM_OK;
}

static fm_status add_spec_name(fm_selection *selection, fm_listed list, const fm_yaml *value,
                               const char *path, fm_error *err)
{
    char origin[FM_PATH_MAX_BYTES + 32], name[FM_PATH_MAX_BYTES];
    snprintf(origin, sizeof origin, "%.1000s:%u", path, value->line);
    if (value->kind != FM_YAML_SCALAR)
        return fm_fail(err, FM_INVALID, "%s: a name is expected here", origin);
    const size_t length = strlen(value->text);
    const bool is_path =
        list == FM_LISTED_SCENES && length > 4 && strcmp(value->text + length - 4, ".yml") == 0;
    if (!path_beside(name, sizeof name, is_path ? path : "", value->text))
        return fm_fail(err, FM_INVALID, "%s: a name that is too long", origin);
    return add_name(selection, list, name, origin, err);
}

static fm_status read_spec_list(fm_selection *selection, fm_listed list, const fm_yaml *item,
                                const char *path, fm_error *err)
{
    if (item->kind == FM_YAML_SCALAR)
        return add_spec_name(selection, list, item, path, err);
    if (item->kind == FM_YAML_MAP)
        return fm_fail(err, FM_INVALID, "%s:%u: %s: not a list of names", path, item->line,
                       item->key);
    for (size_t i = 0; i < item->count; i++) {
        const fm_status status = add_spec_name(selection, list, &item->items[i], path, err);
        if (status != FM_OK)
            return status;
    }
    return FM_OK;
}

static fm_status add_spec_value(fm_sweep *sweep, const fm_yaml *value, const char *path,
                                fm_error *err)
{
    char text[FM_PATH_MAX_BYTES];
    static const fm_key option = { .type = FM_KEY_ENUM }; /* one scalar */
    const fm_key *key = sweep->key != NULL ? sweep->key : &option;
    if (scene_file_value(text, key, value, path, NULL) != FM_OK)
        return fm_fail(err, FM_INVALID, "%s:%u: %s: not a value or a list of values", path,
                       value->line, sweep->name);
    return sweep_add(sweep, text, err);
}

/* "eye: [0, 0, 1]" is one value, "eye: ["0 0 1", "0 0 2"]" and "k: [4, 8]" are two. */
static bool is_one_value(const fm_sweep *sweep, const fm_yaml *item)
{
    double number = 0;
    return item->kind != FM_YAML_LIST ||
           (sweep->key != NULL && sweep->key->type == FM_KEY_VECTOR && item->count == 3 &&
            item->items[0].kind == FM_YAML_SCALAR && text_to_double(&number, item->items[0].text));
}

static fm_status fill_spec_sweep(fm_sweep *sweep, const fm_yaml *item, const char *path,
                                 fm_error *err)
{
    if (is_one_value(sweep, item))
        return add_spec_value(sweep, item, path, err);
    for (size_t i = 0; i < item->count; i++) {
        const fm_status status = add_spec_value(sweep, &item->items[i], path, err);
        if (status != FM_OK)
            return status;
    }
    return FM_OK;
}

static fm_status read_spec_item(fm_selection *from_spec, const fm_yaml *item, const char *path,
                                fm_error *err)
{
    fm_sweep sweep = { 0 };
    char origin[FM_PATH_MAX_BYTES + 32];
    const fm_listed list = listed_find(item->key);
    if (list != FM_LISTED_COUNT)
        return read_spec_list(from_spec, list, item, path, err);
    snprintf(origin, sizeof origin, "%.1000s:%u", path, item->line);
    fm_status status = sweep_create(&sweep, item->key, origin, err);
    if (status == FM_OK)
        status = fill_spec_sweep(&sweep, item, path, err);
    if (status == FM_OK)
        return keep_sweep(from_spec, &sweep, err);
    sweep_destroy(&sweep);
    return status;
}

/* Moves into selection what the command line left open. */
static fm_status merge(fm_selection *selection, fm_selection *from_spec, fm_error *err)
{
    fm_status status = FM_OK;
    for (size_t i = 0; i < FM_LISTED_COUNT; i++) {
        if (selection->names[i].count > 0)
            continue;
        const fm_text_list names = selection->names[i], origins = selection->origins[i];
        selection->names[i] = from_spec->names[i];
        selection->origins[i] = from_spec->origins[i];
        from_spec->names[i] = names;
        from_spec->origins[i] = origins;
    }
    for (size_t i = 0; status == FM_OK && i < from_spec->sweep_count; i++) {
        fm_sweep *sweep = &from_spec->sweeps[i];
        if (selection_find(selection, sweep->name) != NULL ||
            selection_find(selection, rival(sweep->name)) != NULL)
            continue;
        status = keep_sweep(selection, sweep, err);
        *sweep = (fm_sweep){ 0 };
    }
    return status;
}

static fm_status selection_create(fm_selection *selection, fm_error *err)
{
    *selection = (fm_selection){ 0 };
    selection->sweeps = calloc(FM_MAX_SWEEPS, sizeof *selection->sweeps);
    return selection->sweeps != NULL ? FM_OK : fm_fail(err, FM_NO_MEMORY, "no memory for axes");
}

static fm_status read_spec(fm_selection *selection, const char *path, fm_error *err)
{
    fm_selection from_spec = { 0 };
    fm_yaml *root = NULL;
    fm_status status = selection_create(&from_spec, err);
    if (status != FM_OK)
        goto out;
    status = yaml_tree_read(&root, path, err);
    if (status != FM_OK)
        goto out;
    if (root->kind != FM_YAML_MAP)
        status = fm_fail(err, FM_INVALID, "%s:%u: not 'key: value' lines", path, root->line);
    for (size_t i = 0; status == FM_OK && i < root->count; i++)
        status = read_spec_item(&from_spec, &root->items[i], path, err);
    if (status == FM_OK)
        status = merge(selection, &from_spec, err);
out:
    yaml_tree_free(root);
    selection_free(&from_spec);
    return status;
}

fm_status selection_read(fm_selection *selection, const fm_plan_request *request, fm_error *err)
{
    fm_status status = selection_create(selection, err);
    if (status == FM_OK)
        status = read_command_line(selection, request, err);
    if (status == FM_OK && request->spec != NULL)
        status = read_spec(selection, request->spec, err);
    if (status != FM_OK)
        selection_free(selection);
    return status;
}

void selection_free(fm_selection *selection)
{
    for (size_t i = 0; i < FM_LISTED_COUNT; i++) {
        text_list_free(&selection->names[i]);
        text_list_free(&selection->origins[i]);
    }
    for (size_t i = 0; i < selection->sweep_count; i++)
        sweep_destroy(&selection->sweeps[i]);
    free(selection->sweeps);
    *selection = (fm_selection){ 0 };
}
