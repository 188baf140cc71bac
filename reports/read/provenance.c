#include "provenance.h"

#include <jansson.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/text.h"
#include "model/family.h"

enum { MANIFEST_BYTES = 256 << 20, MANIFEST_SCHEMA = 1 };

/* A text field; absent or of another type: "". */
static const char *field(const json_t *object, const char *name)
{
    const char *text = json_string_value(json_object_get(object, name));
    return text == NULL ? "" : text;
}

static uint32_t read_traits(const json_t *method)
{
    const json_t *names = json_object_get(method, "traits");
    uint32_t traits = 0;
    for (size_t i = 0; i < json_array_size(names); i++) {
        const char *text = json_string_value(json_array_get(names, i));
        for (unsigned bit = 0; text != NULL && trait_name(bit) != NULL; bit++)
            traits |= strcmp(text, trait_name(bit)) == 0 ? 1u << bit : 0;
    }
    return traits;
}

static void read_method(fm_method_info *info, const char *id, const json_t *method)
{
    *info = (fm_method_info){
        .id = id,
        .title = field(method, "title"),
        .citation = field(method, "citation"),
        .version = field(method, "version"),
        .defaults = field(method, "defaults"),
        .family = family_parse(field(method, "family")),
        .marker = marker_parse(field(method, "marker")),
        .is_dashed = json_is_true(json_object_get(method, "dashed")),
        .traits = read_traits(method),
    };
    info->is_control = (info->traits & (FM_TRAIT_CONTROL | FM_TRAIT_FLOOR)) != 0;
    if (info->title[0] == '\0')
        info->title = id;
}

static fm_status read_methods(fm_provenance *manifest, const char *path, json_t *methods,
                              fm_error *err)
{
    const char *id;
    json_t *method;
    if (methods == NULL)
        return FM_OK;
    if (!json_is_object(methods))
        return fm_fail(err, FM_INVALID, "%s: methods: not an object", path);
    manifest->methods = calloc(json_object_size(methods) + 1, sizeof *manifest->methods);
    if (manifest->methods == NULL)
        return fm_fail(err, FM_NO_MEMORY, "%s: methods", path);
    json_object_foreach(methods, id, method)
    {
        if (!json_is_object(method))
            return fm_fail(err, FM_INVALID, "%s: methods.%s: not an object", path, id);
        read_method(&manifest->methods[manifest->method_count++], id, method);
    }
    return FM_OK;
}

static fm_status read_devices(fm_provenance *manifest, const char *path, const json_t *devices,
                              fm_error *err)
{
    if (devices == NULL)
        return FM_OK;
    if (!json_is_array(devices))
        return fm_fail(err, FM_INVALID, "%s: devices: not a list", path);
    manifest->devices = calloc(json_array_size(devices) + 1, sizeof *manifest->devices);
    if (manifest->devices == NULL)
        return fm_fail(err, FM_NO_MEMORY, "%s: devices", path);
    for (size_t i = 0; i < json_array_size(devices); i++) {
        const json_t *device = json_array_get(devices, i);
        if (!json_is_object(device))
            return fm_fail(err, FM_INVALID, "%s: devices[%zu]: not an object", path, i);
        manifest->devices[manifest->device_count++] = (fm_device_info){
            .selector = field(device, "selector"),
            .name = field(device, "name"),
            .driver = field(device, "driver"),
            .api = field(device, "api"),
            .is_software = json_is_true(json_object_get(device, "is_software")),
        };
    }
    return FM_OK;
}

static fm_status read_figures(fm_provenance *manifest, const char *path, const json_t *figures,
                              fm_error *err)
{
    if (figures == NULL)
        return FM_OK;
    if (!json_is_array(figures))
        return fm_fail(err, FM_INVALID, "%s: figures: not a list", path);
    const char **ids = calloc(json_array_size(figures) + 1, sizeof *ids);
    if (ids == NULL)
        return fm_fail(err, FM_NO_MEMORY, "%s: figures", path);
    manifest->figures = ids;
    for (size_t i = 0; i < json_array_size(figures); i++) {
        ids[i] = json_string_value(json_array_get(figures, i));
        if (ids[i] == NULL)
            return fm_fail(err, FM_INVALID, "%s: figures[%zu]: not a text", path, i);
        manifest->figure_count++;
    }
    return FM_OK;
}

/* Scalars as text; false for lists and objects. */
static bool scalar_text(char text[512], const json_t *value)
{
    if (json_is_string(value))
        snprintf(text, 512, "%s", json_string_value(value));
    else if (json_is_integer(value))
        snprintf(text, 512, "%" JSON_INTEGER_FORMAT, json_integer_value(value));
    else if (json_is_real(value))
        snprintf(text, 512, "%g", json_real_value(value));
    else if (json_is_boolean(value))
        snprintf(text, 512, "%s", json_is_true(value) ? "yes" : "no");
    else
        return false;
    return true;
}

static fm_status read_facts(fm_manifest_fact **facts, size_t *count, json_t *object,
                            const char *path, fm_error *err)
{
    const char *name;
    json_t *value;
    if (object == NULL)
        return FM_OK;
    if (!json_is_object(object))
        return fm_fail(err, FM_INVALID, "%s: machine: not an object", path);
    *facts = calloc(json_object_size(object) + 1, sizeof **facts);
    if (*facts == NULL)
        return fm_fail(err, FM_NO_MEMORY, "%s: machine", path);
    json_object_foreach(object, name, value)
    {
        (*facts)[*count].name = name;
        *count += scalar_text((*facts)[*count].value, value);
    }
    return FM_OK;
}

static fm_status read_root(fm_provenance *manifest, const char *path, fm_error *err)
{
    char *bytes = NULL;
    size_t byte_count = 0;
    fm_status status = text_read_file(&bytes, &byte_count, path, MANIFEST_BYTES, err);
    if (status != FM_OK)
        return status;
    json_error_t problem = { 0 };
    json_t *root =
        json_loadb(bytes == NULL ? "" : bytes, byte_count, JSON_REJECT_DUPLICATES, &problem);
    free(bytes);
    manifest->json = root;
    if (root == NULL)
        return fm_fail(err, FM_INVALID, "%s:%d: %s", path, problem.line, problem.text);
    if (!json_is_object(root))
        return fm_fail(err, FM_INVALID, "%s:1: not a JSON object", path);
    const json_t *schema = json_object_get(root, "schema");
    if (schema == NULL || json_integer_value(schema) == MANIFEST_SCHEMA)
        return FM_OK;
    char text[512] = "";
    scalar_text(text, schema);
    return fm_fail(err, FM_INVALID, "%s: schema: \"%.40s\"; this program reads schema %d", path,
                   text, MANIFEST_SCHEMA);
}

fm_status provenance_read(fm_provenance **manifest, const char *path, fm_error *err)
{
    *manifest = NULL;
    fm_provenance *made = calloc(1, sizeof *made);
    if (made == NULL)
        return fm_fail(err, FM_NO_MEMORY, "%s", path);
    fm_status status = read_root(made, path, err);
    json_t *root = made->json;
    if (status == FM_OK)
        status = read_methods(made, path, json_object_get(root, "methods"), err);
    if (status == FM_OK)
        status = read_devices(made, path, json_object_get(root, "devices"), err);
    if (status == FM_OK)
        status = read_figures(made, path, json_object_get(root, "figures"), err);
    if (status == FM_OK)
        status = read_facts(&made->machine, &made->machine_count, json_object_get(root, "machine"),
                            path, err);
    if (status == FM_OK)
        status = read_facts(&made->facts, &made->fact_count, root, path, err);
    if (status != FM_OK) {
        provenance_close(made);
        return status;
    }
    *manifest = made;
    return FM_OK;
}

void provenance_close(fm_provenance *manifest)
{
    if (manifest == NULL)
        return;
    free(manifest->methods);
    free(manifest->devices);
    free(manifest->figures);
    free(manifest->machine);
    free(manifest->facts);
    json_decref(manifest->json);
    free(manifest);
}

const fm_method_info *provenance_method(const fm_provenance *manifest, const char *id)
{
    for (size_t i = 0; i < manifest->method_count; i++)
        if (strcmp(manifest->methods[i].id, id) == 0)
            return &manifest->methods[i];
    return NULL;
}

const fm_device_info *provenance_device(const fm_provenance *manifest, const char *selector,
                                        const char *name)
{
    for (size_t i = 0; i < manifest->device_count; i++)
        if (strcmp(manifest->devices[i].selector, selector) == 0)
            return &manifest->devices[i];
    for (size_t i = 0; i < manifest->device_count; i++)
        if (strcmp(manifest->devices[i].name, name) == 0)
            return &manifest->devices[i];
    return NULL;
}

static const char *find_fact(const fm_manifest_fact *facts, size_t count, const char *name)
{
    for (size_t i = 0; i < count; i++)
        if (strcmp(facts[i].name, name) == 0)
            return facts[i].value;
    return "";
}

const char *provenance_fact(const fm_provenance *manifest, const char *name)
{
    return find_fact(manifest->facts, manifest->fact_count, name);
}

const char *provenance_machine_fact(const fm_provenance *manifest, const char *name)
{
    return find_fact(manifest->machine, manifest->machine_count, name);
}

fm_hardware provenance_hardware(const fm_provenance *manifest)
{
    fm_hardware hardware = { provenance_machine_fact(manifest, "cpu"),
                             provenance_machine_fact(manifest, "cores"), NAN };
    const char *memory = provenance_machine_fact(manifest, "memory_bytes");
    if (!text_to_double(&hardware.memory_bytes, memory))
        hardware.memory_bytes = NAN;
    return hardware;
}
