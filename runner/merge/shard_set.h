/* All folders that are to be merged, and which of them has which case. */
#ifndef FM_SHARD_SET_H
#define FM_SHARD_SET_H

#include "base/text_index.h"
#include "shard_folder.h"

#define SHARD_NONE SIZE_MAX

/* A row of a summary. */
typedef struct shard_row {
    size_t folder, row; /* folder SHARD_NONE: none */
} shard_row;

typedef struct shard_set {
    shard_folder *folders; /* [count], by the number of their shard; owned */
    size_t count;
    const fm_table *cases; /* of the whole plan: shard.csv, which is the same in all */
    fm_text_index ids;     /* of the cases */
    shard_row *taken;      /* [cases->row_count]: the row that is merged of each case */
} shard_set;

/* Starts as {0}; shard_set_close whatever the status. FM_INVALID as shard_folder_open; a shard
 * twice; another plan. */
fm_status shard_set_open(shard_set *set, const char *const *paths, bool *is_damaged, fm_error *err);
void shard_set_close(shard_set *set);

/* The id of a case by its place in the plan. */
const char *shard_set_id(const shard_set *set, size_t case_index);
/* Whether the folder is one of those that are to have the case. */
bool shard_set_is_due(const shard_set *set, size_t folder, size_t case_index);

#endif
