/* What a pack says of itself. */
#ifndef FM_PACK_PAPERS_H
#define FM_PACK_PAPERS_H

#include <jansson.h>

#include "bundle/items.h"

/* README of results with this manifest, as a file at path. */
fm_status pack_write_readme(const char *path, const char *name, const json_t *manifest,
                            fm_error *err);
/* FOLDER/pack.json, which lists the items, once they were copied; id: of pack.h. */
fm_status pack_write_list(char id[17], const char *folder, const bundle_items *items,
                          const json_t *manifest, fm_error *err);

#endif
