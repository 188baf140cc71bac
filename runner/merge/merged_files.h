/* The files of shards that a merged folder has as they are. */
#ifndef FM_MERGED_FILES_H
#define FM_MERGED_FILES_H

#include "shard_set.h"

/* Copies images/ and kept/ of the rows that are merged, and what all shards have alike: specs/ and
 * memory.csv. FM_IO; FM_NO_MEMORY. */
fm_status merged_files_copy(const shard_set *set, const char *directory, fm_error *err);

#endif
