/* `fragmark merge`: folders of shards (plan/shard.h) become one folder of results.
 *
 * The room merge reads finished folders, as untrusted as any file, and writes one:
 *
 *   summary.csv    a row a case, in the order of the whole plan: the row of the shard it belongs to
 *   samples.csv    the samples of those rows; column run_id says of which shard they are
 *   shards.csv     a row for each case of each shard, with its times there; references stand in it
 *                  once a shard. Times of two shards are never pooled
 *   manifest.json  as of a run; what the shards are stands under `merged`, and what differs between
 *                  their machines is listed side by side
 *   images/ kept/ specs/ figures.csv memory.csv    as the shards have them
 *
 * From below: shard_folder.h is one folder, shard_set.h all of them and who has which case; agree.h
 * and overlap.h say whether they fit; merged_*.h write. */
#ifndef FM_MERGE_H
#define FM_MERGE_H

#include "base/text.h"

typedef struct fm_merge_desc {
    const char *const *folders; /* of shards, in any order; ends with NULL */
    const char *directory; /* is made; it may be empty, or hold an earlier merge of this plan */
    const char *command;   /* for the manifest */
} fm_merge_desc;

/* Starts as {0}; the caller frees `missing`, whatever the status. */
typedef struct fm_merge_result {
    uint32_t shard_count;               /* N */
    uint32_t given;                     /* folders */
    size_t case_count;                  /* of the whole plan */
    uint32_t ok, not_supported, failed; /* rows that were merged */
    fm_text_list missing;               /* a sentence for each shard that lacks or is unfinished */
    bool is_damaged;                    /* a file of a shard is damaged or foreign */
} fm_merge_result;

/* FM_INVALID: no such folder, a folder that is no shard, or, with is_damaged, a damaged or foreign
 * one; a shard twice, shards of two plans; a directory that cannot be made, or holds something
 * else. FM_UNSUPPORTED: shards do not compare: another program, plugin or GLSL, or a case that two
 * have and whose deterministic columns differ, with case and column. Nothing was written then.
 * FM_IO: a file cannot be written; the same merge again replaces what is there. FM_NO_MEMORY. */
fm_status merge_shards(fm_merge_result *result, const fm_merge_desc *desc, fm_error *err);

#endif
