/* YAML files as small trees that remember their lines. (Not yaml.h: that is libyaml's.)
 *
 * Refused with FM_INVALID and "path:line: ...": syntax errors, more than one document, aliases (so
 * that no file unfolds to more than it holds), duplicate keys, keys that are not plain texts, NUL
 * bytes, and files beyond the limits below, which hold while a file is parsed: whatever it holds is
 * read or refused in well under a second. */
#ifndef FM_YAML_TREE_H
#define FM_YAML_TREE_H

#include <stddef.h>
#include <stdint.h>

#include "error.h"

enum {
    FM_YAML_MAX_BYTES = 1 << 20,
    FM_YAML_MAX_DEPTH = 16,
    FM_YAML_MAX_NODES = 65536,
    FM_YAML_MAX_KEYS = 1024, /* of one mapping */
    FM_YAML_MAX_DIRECTIVES = 8,
};

typedef enum fm_yaml_kind {
    FM_YAML_SCALAR,
    FM_YAML_LIST,
    FM_YAML_MAP,
} fm_yaml_kind;

typedef struct fm_yaml {
    fm_yaml_kind kind;
    uint32_t line;         /* from 1; of the key for a mapping's values */
    char *key;             /* of a mapping's values, else NULL */
    char *text;            /* scalars, else NULL */
    struct fm_yaml *items; /* lists and mappings, in the file's order */
    size_t count;
} fm_yaml;

/* Reads a file; comments alone are an empty mapping. FM_IO, FM_NO_MEMORY, or FM_INVALID as above
 * and for a file of no bytes, which is what a full disk leaves. */
fm_status yaml_tree_read(fm_yaml **root, const char *path, fm_error *err);
/* The same from memory; name stands for the path in messages. */
fm_status yaml_tree_parse(fm_yaml **root, const char *bytes, size_t count, const char *name,
                          fm_error *err);
void yaml_tree_free(fm_yaml *root);
/* The value under key; NULL: none, or map is not a mapping. */
const fm_yaml *yaml_tree_find(const fm_yaml *map, const char *key);

#endif
