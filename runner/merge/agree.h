/* Whether shards were measured by one code, and their folders written alike. */
#ifndef FM_MERGE_AGREE_H
#define FM_MERGE_AGREE_H

#include "shard_set.h"

/* FM_UNSUPPORTED: other version, program, plugin or GLSL, naming the file and two shards; drivers
 * may differ, as machines do. FM_INVALID: other columns, `--validation` or `--no-timers`; or, with
 * *is_damaged, codes in a manifest that are none. FM_NO_MEMORY. */
fm_status agree_check(const shard_set *set, bool *is_damaged, fm_error *err);

#endif
