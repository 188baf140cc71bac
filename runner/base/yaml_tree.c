#include "yaml_tree.h"

#include <stdbool.h>
#include <stdlib.h>
#include <string.h>
#include <yaml.h>

#include "text.h"

/* The tree is made event by event: libyaml composes a whole document before it can be looked at, in
 * a time that grows with the square of its depth. */
typedef struct reader {
    yaml_parser_t parser;
    yaml_event_t event; /* the one that is looked at; owned */
    size_t node_count;
    const char *name;
    fm_error *err;
} reader;

static uint32_t event_line(const reader *from)
{
    return (uint32_t)from->event.start_mark.line + 1;
}

static fm_status no_memory(const reader *from)
{
    return fm_fail(from->err, FM_NO_MEMORY, "%s: no memory for its tree", from->name);
}

static fm_status syntax_error(const reader *from)
{
    const yaml_parser_t *parser = &from->parser;
    if (parser->error == YAML_MEMORY_ERROR)
        return no_memory(from);
    /* What is no character at all has a place in bytes, and a line where it was met. */
    const size_t line =
        (parser->problem_mark.line > 0 ? parser->problem_mark.line : parser->mark.line) + 1;
    return fm_fail(from->err, FM_INVALID, "%s:%zu: %s%s%s", from->name, line,
                   parser->context != NULL ? parser->context : "",
                   parser->context != NULL ? ", " : "",
                   parser->problem != NULL ? parser->problem : "not YAML");
}

/* Looks at the next event. */
static fm_status advance(reader *from)
{
    yaml_event_delete(&from->event);
    if (yaml_parser_parse(&from->parser, &from->event))
        return FM_OK;
    return syntax_error(from);
}

static void node_clear(fm_yaml *node)
{
    for (size_t i = 0; i < node->count; i++)
        node_clear(&node->items[i]);
    free(node->items);
    free(node->key);
    free(node->text);
}

static fm_status copy_scalar(char **text, const reader *from)
{
    const char *bytes = (const char *)from->event.data.scalar.value;
    const size_t length = from->event.data.scalar.length;
    if (memchr(bytes, '\0', length) != NULL)
        return fm_fail(from->err, FM_INVALID, "%s:%u: a NUL byte", from->name, event_line(from));
    *text = strndup(bytes, length);
    return *text != NULL ? FM_OK : no_memory(from);
}

/* One more item, which is all zero; NULL: no memory. */
static fm_yaml *add_item(fm_yaml *to)
{
    if ((to->count & (to->count - 1)) == 0) { /* full: 0, 1, 2, 4, ... */
        const size_t room = to->count > 0 ? 2 * to->count : 1;
        fm_yaml *grown = reallocarray(to->items, room, sizeof *grown);
        if (grown == NULL)
            return NULL;
        to->items = grown;
    }
    to->items[to->count] = (fm_yaml){ .kind = FM_YAML_SCALAR };
    return &to->items[to->count++];
}

static fm_status read_node(fm_yaml *to, reader *from, int depth);

static fm_status read_list(fm_yaml *to, reader *from, int depth)
{
    to->kind = FM_YAML_LIST;
    fm_status status = advance(from);
    while (status == FM_OK && from->event.type != YAML_SEQUENCE_END_EVENT) {
        fm_yaml *item = add_item(to);
        status = item != NULL ? read_node(item, from, depth + 1) : no_memory(from);
        if (status == FM_OK)
            status = advance(from);
    }
    return status;
}

static fm_status read_key(fm_yaml *map, fm_yaml *to, const reader *from)
{
    const uint32_t line = event_line(from);
    if (from->event.type != YAML_SCALAR_EVENT)
        return fm_fail(from->err, FM_INVALID, "%s:%u: a key that is not a plain text", from->name,
                       line);
    const fm_status status = copy_scalar(&to->key, from);
    for (size_t i = 0; status == FM_OK && i + 1 < map->count; i++)
        if (strcmp(map->items[i].key, to->key) == 0)
            return fm_fail(from->err, FM_INVALID, "%s:%u: '%.200s' stands on line %u already",
                           from->name, line, to->key, map->items[i].line);
    to->line = line;
    return status;
}

static fm_status read_pair(fm_yaml *map, reader *from, int depth)
{
    if (map->count >= FM_YAML_MAX_KEYS)
        return fm_fail(from->err, FM_INVALID, "%s:%u: more than %d keys", from->name,
                       event_line(from), FM_YAML_MAX_KEYS);
    fm_yaml *to = add_item(map);
    fm_status status = to != NULL ? read_key(map, to, from) : no_memory(from);
    if (status == FM_OK)
        status = advance(from);
    if (status != FM_OK)
        return status;
    const uint32_t line = to->line;
    status = read_node(to, from, depth + 1);
    to->line = line;
    return status;
}

static fm_status read_map(fm_yaml *to, reader *from, int depth)
{
    to->kind = FM_YAML_MAP;
    fm_status status = advance(from);
    while (status == FM_OK && from->event.type != YAML_MAPPING_END_EVENT) {
        status = read_pair(to, from, depth);
        if (status == FM_OK)
            status = advance(from);
    }
    return status;
}

/* The node that begins with the event, up to its last event. */
static fm_status read_node(fm_yaml *to, reader *from, int depth)
{
    to->line = event_line(from);
    if (from->event.type == YAML_ALIAS_EVENT)
        return fm_fail(from->err, FM_INVALID, "%s:%u: an anchor is used again: write it out",
                       from->name, to->line);
    if (depth >= FM_YAML_MAX_DEPTH)
        return fm_fail(from->err, FM_INVALID, "%s:%u: nested deeper than %d", from->name, to->line,
                       FM_YAML_MAX_DEPTH);
    if (++from->node_count > FM_YAML_MAX_NODES)
        return fm_fail(from->err, FM_INVALID, "%s:%u: more than %d values", from->name, to->line,
                       FM_YAML_MAX_NODES);
    if (from->event.type == YAML_SEQUENCE_START_EVENT)
        return read_list(to, from, depth);
    if (from->event.type == YAML_MAPPING_START_EVENT)
        return read_map(to, from, depth);
    to->kind = FM_YAML_SCALAR;
    return copy_scalar(&to->text, from);
}

/* The events of a stream: its start, a document's start, a node, the document's end, its end. */
static fm_status read_document(fm_yaml *root, reader *from)
{
    fm_status status = advance(from);
    if (status == FM_OK)
        status = advance(from);
    if (status == FM_OK && from->event.type == YAML_STREAM_END_EVENT) {
        root->kind = FM_YAML_MAP;
        root->line = 1;
        return FM_OK;
    }
    if (status == FM_OK)
        status = advance(from);
    if (status == FM_OK)
        status = read_node(root, from, 0);
    if (status == FM_OK)
        status = advance(from);
    if (status == FM_OK)
        status = advance(from);
    if (status == FM_OK && from->event.type != YAML_STREAM_END_EVENT)
        return fm_fail(from->err, FM_INVALID, "%s:%u: a second document", from->name,
                       event_line(from));
    return status;
}

/* libyaml compares each directive with all before it. They begin with '%' in the first column,
 * where nothing that a file needs does. */
static fm_status check_directives(const char *bytes, size_t count, const char *name, fm_error *err)
{
    uint32_t line = 1, directives = 0;
    bool is_first = true;
    for (size_t i = 0; i < count; i++) {
        if (is_first && bytes[i] == '%' && ++directives > FM_YAML_MAX_DIRECTIVES)
            return fm_fail(err, FM_INVALID, "%s:%u: more than %d directives", name, line,
                           FM_YAML_MAX_DIRECTIVES);
        is_first = bytes[i] == '\n' || bytes[i] == '\r';
        line += bytes[i] == '\n';
    }
    return FM_OK;
}

fm_status yaml_tree_parse(fm_yaml **root, const char *bytes, size_t count, const char *name,
                          fm_error *err)
{
    reader from = { .name = name, .err = err };
    *root = NULL;
    fm_status status = check_directives(bytes, count, name, err);
    if (status != FM_OK)
        return status;
    fm_yaml *tree = calloc(1, sizeof *tree);
    if (tree == NULL || !yaml_parser_initialize(&from.parser)) {
        free(tree);
        return no_memory(&from);
    }
    yaml_parser_set_input_string(&from.parser, (const unsigned char *)bytes, count);
    status = read_document(tree, &from);
    if (status == FM_OK) {
        *root = tree;
        tree = NULL;
    }
    yaml_event_delete(&from.event);
    yaml_parser_delete(&from.parser);
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
