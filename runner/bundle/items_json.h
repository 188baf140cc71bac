/* Lists of files as JSON, and JSON files as such. */
#ifndef FM_BUNDLE_ITEMS_JSON_H
#define FM_BUNDLE_ITEMS_JSON_H

#include <jansson.h>

#include "items.h"

/* [{ "path": as in the folder, "from": where it was, "bytes", "xxh3_64": 16 hex digits }]. */
json_t *items_json(const bundle_items *items);

/* DIRECTORY/NAME, which holds an object. FM_INVALID with file and line; FM_IO; FM_NO_MEMORY. The
 * caller drops *json. */
fm_status json_read_object(json_t **json, const char *directory, const char *name, fm_error *err);

#endif
