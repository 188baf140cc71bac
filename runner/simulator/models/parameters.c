#include "parameters.h"

#include <stdbool.h>
#include <string.h>

#include "base/text.h"
#include "base/yaml_tree.h"
#include "model/settings.h"

extern const unsigned char model_parameters_yml[];
extern const size_t model_parameters_yml_bytes;

static const char *const names[MODEL_PARAMETER_COUNT] = {
#define MODEL_NAME(name) #name,
    MODEL_PARAMETERS(MODEL_NAME)
#undef MODEL_NAME
};

double *model_parameter(model_parameters *parameters, size_t index)
{
    return (double *)(void *)((char *)parameters + index * sizeof(double));
}

static bool read_number(double *value, const fm_yaml *entry, const char *key)
{
    const fm_yaml *field = yaml_tree_find(entry, key);
    return field != NULL && field->kind == FM_YAML_SCALAR && text_to_double(value, field->text);
}

static fm_status read_entry(model_table *table, size_t index, const fm_yaml *root, fm_error *err)
{
    const fm_yaml *entry = yaml_tree_find(root, names[index]);
    double value = 0, other = 0;
    if (entry == NULL || !read_number(&value, entry, "value") ||
        yaml_tree_find(entry, "source") == NULL)
        return fm_fail(err, FM_INVALID, "parameters.yml: %s: needs value and source", names[index]);
    *model_parameter(&table->nominal, index) = value;
    *model_parameter(&table->low, index) = read_number(&other, entry, "low") ? other : value;
    *model_parameter(&table->high, index) = read_number(&other, entry, "high") ? other : value;
    *model_parameter(&table->hp, index) = read_number(&other, entry, "hp") ? other : value;
    return FM_OK;
}

static fm_status read_table(model_table *table, fm_error *err)
{
    fm_yaml *root = NULL;
    fm_status status = yaml_tree_parse(&root, (const char *)model_parameters_yml,
                                       model_parameters_yml_bytes, "parameters.yml", err);
    for (size_t i = 0; i < MODEL_PARAMETER_COUNT && status == FM_OK; i++)
        status = read_entry(table, i, root, err);
    if (status == FM_OK && root->count != MODEL_PARAMETER_COUNT)
        status = fm_fail(err, FM_INVALID, "parameters.yml: %zu entries, the models know %d",
                         root->count, MODEL_PARAMETER_COUNT);
    yaml_tree_free(root);
    return status;
}

static fm_status override(model_table *table, char *word, fm_error *err)
{
    char *equals = strchr(word, '=');
    double value = 0;
    if (equals == NULL)
        return fm_fail(err, FM_INVALID, "model: '%s' is not NAME=VALUE", word);
    *equals = '\0';
    if (!text_to_double(&value, equals + 1) || !(value > 0))
        return fm_fail(err, FM_INVALID, "model: %s: '%s' is not a number above 0", word,
                       equals + 1);
    for (size_t i = 0; i < MODEL_PARAMETER_COUNT; i++) {
        if (strcmp(names[i], word) != 0)
            continue;
        *model_parameter(&table->nominal, i) = value;
        *model_parameter(&table->hp, i) = value;
        return FM_OK;
    }
    const char *nearest = text_nearest(word, names, MODEL_PARAMETER_COUNT);
    return fm_fail(err, FM_INVALID, "model: no parameter '%s'%s%s%s", word,
                   nearest != NULL ? "; the nearest is '" : "", nearest != NULL ? nearest : "",
                   nearest != NULL ? "'" : "");
}

static fm_status check_queues(const model_parameters *p, fm_error *err)
{
    const struct {
        const char *name;
        double length;
    } queues[] = { { "overlapped_tiles_queue", p->overlapped_tiles_queue },
                   { "tile_queue", p->tile_queue } };
    for (size_t i = 0; i < sizeof queues / sizeof queues[0]; i++)
        if (queues[i].length < 1 || queues[i].length > MODEL_QUEUE_MAX)
            return fm_fail(err, FM_INVALID, "model: %s: %g: 1 to %d entries", queues[i].name,
                           queues[i].length, MODEL_QUEUE_MAX);
    return FM_OK;
}

fm_status model_table_read(model_table *table, const char *overrides, fm_error *err)
{
    char copy[FM_PATH_MAX_BYTES], *rest = copy;
    fm_status status = read_table(table, err);
    if (strlen(overrides) >= sizeof copy)
        return fm_fail(err, FM_INVALID, "model: longer than %zu bytes", sizeof copy - 1);
    strcpy(copy, overrides);
    for (char *word; status == FM_OK && (word = strsep(&rest, " ")) != NULL;)
        if (*word != '\0')
            status = override(table, word, err);
    return status == FM_OK ? check_queues(&table->nominal, err) : status;
}
