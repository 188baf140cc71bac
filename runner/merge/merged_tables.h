/* The tables of a merged folder: merge.h lists them. */
#ifndef FM_MERGED_TABLES_H
#define FM_MERGED_TABLES_H

#include "shard_set.h"

/* Writes them into the directory, each whole or not at all. FM_INVALID, with *is_damaged: a table
 * of a shard cannot be. FM_IO; FM_NO_MEMORY. */
fm_status merged_tables_write(const shard_set *set, const char *directory, bool *is_damaged,
                              fm_error *err);

#endif
