#include "yaml_tree.h"

#include <stdbool.h>
#include <stdlib.h>
#include <string.h>
#include <yaml.h>

#include "text.h"

/* What a conversion carries: the document, and which of its nodes were met already. */
typedef struct converter {
    yaml_document_t *document;
    bool *is_met;
    size_t node_count;
    const char *name;
    fm_error *err;
} converter;

static uint32_t node_line(const yaml_node_t *node)
{
    return (uint32_t)node->start_mark.line + 1;
}

static fm_status no_memory(const converter *from)
{
    return fm_fail(from->err, FM_NO_MEMORY, "%s: no memory for its tree", from->name);
}

static void node_clear(fm_yaml *node)
{
    for (size_t i = 0; i < node->count; i++)
        node_clear(&node->items[i]);
    free(node->items);
    free(node->key);
    free(node->text);
}

static fm_status copy_scalar(char **text, const converter *from, const yaml_node_t *node)
{
    const char *bytes = (const char *)node->data.scalar.value;
    const size_t length = node->data.scalar.length;
    if (memchr(bytes, '\0', length) != NULL)
        return fm_fail(from->err, FM_INVALID, "%s:%u: a NUL byte", from->name, node_line(node));
    *text = strndup(bytes, length);
    return *text != NULL ? FM_OK : no_memory(from);
}

static fm_status convert(fm_yaml *to, converter *from, int id, int depth);

static fm_status convert_list(fm_yaml *to, converter *from, const yaml_node_t *node, int depth)
{
    const yaml_node_item_t *start = node->data.sequence.items.start;
    const size_t count = (size_t)(node->data.sequence.items.top - start);
    to->kind = FM_YAML_LIST;
    to->items = calloc(count + 1, sizeof *to->items);
    if (to->items == NULL)
        return no_memory(from);
    for (size_t i = 0; i < count; i++) {
        to->count++;
        const fm_status status = convert(&to->items[i], from, start[i], depth + 1);
        if (status != FM_OK)
            return status;
    }
    return FM_OK;
}

static fm_status convert_key(fm_yaml *to, converter *from, int id)
{
    const yaml_node_t *node = yaml_document_get_node(from->document, id);
    if (node->type != YAML_SCALAR_NODE)
        return fm_fail(from->err, FM_INVALID, "%s:%u: a key that is not a plain text", from->name,
                       node_line(node));
    const fm_status status = copy_scalar(&to->key, from, node);
    to->line = node_line(node);
    return status;
}

static fm_status convert_pair(fm_yaml *map, converter *from, const yaml_node_pair_t *pair,
                              int depth)
{
    fm_yaml *to = &map->items[map->count++];
    fm_status status = convert_key(to, from, pair->key);
    if (status != FM_OK)
        return status;
    for (size_t i = 0; i + 1 < map->count; i++)
        if (strcmp(map->items[i].key, to->key) == 0)
            return fm_fail(from->err, FM_INVALID, "%s:%u: '%.200s' stands on line %u already",
                           from->name, to->line, to->key, map->items[i].line);
    const uint32_t line = to->line;
    status = convert(to, from, pair->value, depth + 1);
    to->line = line;
    return status;
}

static fm_status convert_map(fm_yaml *to, converter *from, const yaml_node_t *node, int depth)
{
    const yaml_node_pair_t *start = node->data.mapping.pairs.start;
    const size_t count = (size_t)(node->data.mapping.pairs.top - start);
    to->kind = FM_YAML_MAP;
    if (count > FM_YAML_MAX_KEYS)
        return fm_fail(from->err, FM_INVALID, "%s:%u: %zu keys; at most %d", from->name,
                       node_line(node), count, FM_YAML_MAX_KEYS);
    to->items = calloc(count + 1, sizeof *to->items);
    if (to->items == NULL)
        return no_memory(from);
    for (size_t i = 0; i < count; i++) {
        const fm_status status = convert_pair(to, from, &start[i], depth);
        if (status != FM_OK)
            return status;
    }
    return FM_OK;
}

static fm_status convert(fm_yaml *to, converter *from, int id, int depth)
{
    const yaml_node_t *node = yaml_document_get_node(from->document, id);
    to->line = node_line(node);
    if (depth >= FM_YAML_MAX_DEPTH)
        return fm_fail(from->err, FM_INVALID, "%s:%u: nested deeper than %d", from->name, to->line,
                       FM_YAML_MAX_DEPTH);
    if (from->is_met[id - 1])
        return fm_fail(from->err, FM_INVALID, "%s:%u: an anchor is used again: write it out",
                       from->name, to->line);
    from->is_met[id - 1] = true;
    switch (node->type) {
    case YAML_SCALAR_NODE:
        to->kind = FM_YAML_SCALAR;
        return copy_scalar(&to->text, from, node);
    case YAML_SEQUENCE_NODE:
        return convert_list(to, from, node, depth);
    case YAML_MAPPING_NODE:
        return convert_map(to, from, node, depth);
    case YAML_NO_NODE:
        break;
    }
    return fm_fail(from->err, FM_INVALID, "%s:%u: not a YAML node", from->name, to->line);
}

static fm_status convert_document(fm_yaml *root, yaml_document_t *document, const char *name,
                                  fm_error *err)
{
    converter from = { .document = document, .name = name, .err = err };
    from.node_count = (size_t)(document->nodes.top - document->nodes.start);
    if (from.node_count == 0) {
        root->kind = FM_YAML_MAP;
        root->line = 1;
        return FM_OK;
    }
    if (from.node_count > FM_YAML_MAX_NODES)
        return fm_fail(err, FM_INVALID, "%s: %zu values; at most %d", name, from.node_count,
                       FM_YAML_MAX_NODES);
    from.is_met = calloc(from.node_count, sizeof *from.is_met);
    if (from.is_met == NULL)
        return no_memory(&from);
    const fm_status status = convert(root, &from, 1, 0);
    free(from.is_met);
    return status;
}

static fm_status syntax_error(const yaml_parser_t *parser, const char *name, fm_error *err)
{
    if (parser->error == YAML_MEMORY_ERROR)
        return fm_fail(err, FM_NO_MEMORY, "%s: no memory to parse it", name);
    const size_t line = parser->problem_mark.line + 1;
    return fm_fail(err, FM_INVALID, "%s:%zu: %s%s%s", name, line,
                   parser->context != NULL ? parser->context : "",
                   parser->context != NULL ? ", " : "",
                   parser->problem != NULL ? parser->problem : "not YAML");
}

static fm_status expect_end(yaml_parser_t *parser, const char *name, fm_error *err)
{
    yaml_document_t second;
    if (!yaml_parser_load(parser, &second))
        return syntax_error(parser, name, err);
    const bool is_end = yaml_document_get_root_node(&second) == NULL;
    const size_t line = second.start_mark.line + 1;
    yaml_document_delete(&second);
    return is_end ? FM_OK : fm_fail(err, FM_INVALID, "%s:%zu: a second document", name, line);
}

fm_status yaml_tree_parse(fm_yaml **root, const char *bytes, size_t count, const char *name,
                          fm_error *err)
{
    fm_status status = FM_OK;
    yaml_parser_t parser;
    yaml_document_t document;
    *root = NULL;
    fm_yaml *tree = calloc(1, sizeof *tree);
    if (tree == NULL || !yaml_parser_initialize(&parser)) {
        free(tree);
        return fm_fail(err, FM_NO_MEMORY, "%s: no memory to parse it", name);
    }
    yaml_parser_set_input_string(&parser, (const unsigned char *)bytes, count);
    if (!yaml_parser_load(&parser, &document)) {
        status = syntax_error(&parser, name, err);
        goto out;
    }
    status = convert_document(tree, &document, name, err);
    const bool is_empty = yaml_document_get_root_node(&document) == NULL;
    yaml_document_delete(&document);
    if (status == FM_OK && !is_empty)
        status = expect_end(&parser, name, err);
    if (status == FM_OK) {
        *root = tree;
        tree = NULL;
    }
out:
    yaml_parser_delete(&parser);
    yaml_tree_free(tree);
    return status;
}

fm_status yaml_tree_read(fm_yaml **root, const char *path, fm_error *err)
{
    char *bytes = NULL;
    size_t count = 0;
    *root = NULL;
    fm_status status = text_read_file(&bytes, &count, path, FM_YAML_MAX_BYTES, err);
    if (status == FM_OK && count == 0)
        status = fm_fail(err, FM_INVALID, "%s: is empty", path);
    if (status == FM_OK)
        status = yaml_tree_parse(root, bytes, count, path, err);
    free(bytes);
    return status;
}

void yaml_tree_free(fm_yaml *root)
{
    if (root == NULL)
        return;
    node_clear(root);
    free(root);
}

const fm_yaml *yaml_tree_find(const fm_yaml *map, const char *key)
{
    for (size_t i = 0; map->kind == FM_YAML_MAP && i < map->count; i++)
        if (strcmp(map->items[i].key, key) == 0)
            return &map->items[i];
    return NULL;
}
