/* Archives, by the program tar. */
#ifndef FM_PACK_ARCHIVE_H
#define FM_PACK_ARCHIVE_H

#include <stdbool.h>

#include "base/error.h"

/* Whether a name ends as an archive's. */
bool archive_is_named(const char *name);
/* The length of the name without that ending; of others the whole. */
int archive_stem(const char *name);
/* Packs folder ROOT/NAME as ROOT/archive, compressed as the ending of `output` says, with its files
 * in order and without owners. FM_UNSUPPORTED: no tar, or no program that compresses so; FM_IO. */
fm_status archive_make(const char *root, const char *name, const char *output, fm_error *err);
/* Unpacks below the folder root. FM_INVALID: it is no archive, or a damaged one; FM_UNSUPPORTED. */
fm_status archive_unpack(const char *root, const char *path, fm_error *err);

#endif
