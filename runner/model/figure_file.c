#include "figure_file.h"

#include <string.h>

#include "base/yaml_fields.h"

static const char *const keys[] = { "id",    "paper",  "title",    "source",       "run",
                                    "smoke", "large",  "charts",   "paper_points", "deviations",
                                    "table", "claims", "pictures", "untimed" };

static const char *text_of(const fm_yaml *root, const char *key)
{
    const fm_yaml *value = yaml_tree_find(root, key);
    return value != NULL && value->kind == FM_YAML_SCALAR ? value->text : "";
}

static void fill(fm_figure_file *file)
{
    const fm_yaml *root = file->tree;
    file->id = text_of(root, "id");
    file->paper = text_of(root, "paper");
    file->title = text_of(root, "title");
    file->source = text_of(root, "source");
    file->keeps_pictures = strcmp(text_of(root, "pictures"), "true") == 0;
    file->is_untimed = strcmp(text_of(root, "untimed"), "true") == 0;
    file->run = yaml_tree_find(root, "run");
    file->smoke = yaml_tree_find(root, "smoke");
    file->large = yaml_tree_find(root, "large");
    file->charts = yaml_tree_find(root, "charts");
    file->paper_points = yaml_tree_find(root, "paper_points");
    file->claims = yaml_tree_find(root, "claims");
    file->deviations = yaml_tree_find(root, "deviations");
    file->table = yaml_tree_find(root, "table");
}

static fm_status check(const fm_figure_file *file, const fm_yaml_place *at)
{
    static const struct {
        const char *key;
        bool is_needed;
    } texts[] = { { "id", true }, { "paper", true }, { "title", true }, { "source", false } };
    bool is_set;
    const char *text;
    fm_status status =
        field_check_keys(file->tree, "a figure", keys, sizeof keys / sizeof keys[0], at);
    for (size_t i = 0; i < sizeof texts / sizeof texts[0] && status == FM_OK; i++)
        status = field_text(&text, file->tree, texts[i].key, texts[i].is_needed, at);
    if (status == FM_OK)
        status = field_bool(&is_set, file->tree, "pictures", at);
    if (status == FM_OK)
        status = field_bool(&is_set, file->tree, "untimed", at);
    if (status == FM_OK &&
        strspn(file->id, "abcdefghijklmnopqrstuvwxyz0123456789-") != strlen(file->id))
        return fm_fail(at->err, FM_INVALID, "%s: id \"%s\": lower case, digits and hyphens only",
                       at->path, file->id);
    return status;
}

fm_status figure_file_read(fm_figure_file *file, const char *path, fm_error *err)
{
    const fm_yaml_place at = { .path = path, .err = err };
    *file = (fm_figure_file){ .id = "", .paper = "", .title = "", .source = "" };
    const fm_status status = yaml_tree_read(&file->tree, path, err);
    if (status != FM_OK)
        return status;
    fill(file);
    return check(file, &at);
}

void figure_file_close(fm_figure_file *file)
{
    yaml_tree_free(file->tree);
    *file = (fm_figure_file){ 0 };
}
