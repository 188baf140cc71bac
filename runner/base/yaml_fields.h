/* Reading fields of YAML mappings, with messages that name file, line and key. */
#ifndef FM_YAML_FIELDS_H
#define FM_YAML_FIELDS_H

#include <stdbool.h>
#include <stdint.h>

#include "error.h"
#include "text.h"
#include "yaml_tree.h"

/* The file that is being read, and where its errors go. */
typedef struct fm_yaml_place {
    const char *path;
    fm_error *err;
} fm_yaml_place;

/* All of these: FM_INVALID, naming file and line. Texts point into the tree. */

/* `map` is a mapping and has none but these keys; else the nearest known one is named. */
fm_status field_check_keys(const fm_yaml *map, const char *what, const char *const *keys,
                           size_t key_count, const fm_yaml_place *at);
/* A text; `needed` ones must be there and not empty, others become "". */
fm_status field_text(const char **text, const fm_yaml *map, const char *key, bool needed,
                     const fm_yaml_place *at);
/* A number; *value stays when the key is missing. */
fm_status field_number(double *value, const fm_yaml *map, const char *key, const fm_yaml_place *at);
/* A whole number from 0 to `most`, which must be there. */
fm_status field_whole(uint64_t *value, const fm_yaml *map, const char *key, uint64_t most,
                      const fm_yaml_place *at);
/* A list of anything, which must be there; it points into the tree. */
fm_status field_items(const fm_yaml **list, const fm_yaml *map, const char *key,
                      const fm_yaml_place *at);
/* Texts, or one text, added to the list; missing: none. FM_NO_MEMORY. The caller frees the list. */
fm_status field_list(fm_text_list *list, const fm_yaml *map, const char *key,
                     const fm_yaml_place *at);
/* One of these words, as its index; a missing key is the first. */
fm_status field_word(int *index, const fm_yaml *map, const char *key, const char *const *words,
                     size_t word_count, const fm_yaml_place *at);
fm_status field_bool(bool *value, const fm_yaml *map, const char *key, const fm_yaml_place *at);

#endif
