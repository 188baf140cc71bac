/* The files of a bundle: gathered first, so that their size is known, then copied and hashed. */
#ifndef FM_BUNDLE_ITEMS_H
#define FM_BUNDLE_ITEMS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/error.h"
#include "base/text_index.h"

typedef struct bundle_item {
    char *from, *to; /* `to` is seen from the bundle's top */
    uint64_t bytes;
    bool is_program; /* may be executed */
    char hash[17];   /* XXH3, 64 bits, of what was copied */
} bundle_item;

/* Starts as {0}. */
typedef struct bundle_items {
    bundle_item *items;
    size_t count;
    fm_text_index index; /* by `to` */
} bundle_items;

/* Adds the file from, unless `to` is there already. FM_IO: no file, or it may not be read. */
fm_status items_add(bundle_items *items, const char *from, const char *to, fm_error *err);
/* Adds the files below a folder whose names end as one of endings, small or capital, which ends
 * with NULL, or all where endings is NULL; counts those that are new. */
fm_status items_add_tree(bundle_items *items, uint32_t *count, const char *folder, const char *to,
                         const char *const *endings, fm_error *err);
uint64_t items_bytes(const bundle_items *items);
/* Puts them in the order of `to`. None is added after that. */
void items_sort(bundle_items *items);
/* Copies all below the folder root, and fills in the hashes. */
fm_status items_copy(bundle_items *items, const char *root, fm_error *err);
void items_free(bundle_items *items);

/* Removes a folder with all that is in it. */
void tree_remove(const char *root);

#endif
