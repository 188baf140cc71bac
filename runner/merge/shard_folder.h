/* One folder that `run --shard` left, read and checked. */
#ifndef FM_SHARD_FOLDER_H
#define FM_SHARD_FOLDER_H

#include <jansson.h>
#include <stdbool.h>

#include "base/table.h"
#include "plan/shard.h"

typedef struct shard_folder {
    const char *path; /* borrowed */
    json_t *manifest;
    const char *run_id, *plan; /* of the manifest */
    uint32_t index, count;
    fm_table *cases;        /* shard.csv: case_id, shard, is_reference of the whole plan */
    uint32_t *shard_of;     /* [cases->row_count]: the shard that each belongs to; owned */
    fm_table *summary;      /* summary.csv */
    size_t case_id, status; /* columns of the summary */
    size_t *case_of; /* [rows of the summary]: case by its place in the plan, or SHARD_NONE where it
                        is not finished; of shard_set.h; owned */
    size_t finished; /* rows */
} shard_folder;

/* FM_INVALID: there is no such folder, or it is no shard's: a whole run, or merged already; or,
 * with *is_damaged, files are damaged, foreign or lack. FM_IO, with *is_damaged: a file cannot be
 * read. FM_NO_MEMORY. shard_folder_close also then. */
fm_status shard_folder_open(shard_folder *folder, const char *path, bool *is_damaged,
                            fm_error *err);
void shard_folder_close(shard_folder *folder);

/* Whether a row of `cases` is measured in all shards. */
bool shard_case_is_reference(const shard_folder *folder, size_t index);
/* Whether a row of the summary tells how the case ended: not of one that had no turn. */
bool shard_row_is_finished(const shard_folder *folder, size_t row);

#endif
