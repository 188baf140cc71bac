/* manifest.json of a merged folder: as of a run, with what the shards are. */
#ifndef FM_MERGED_MANIFEST_H
#define FM_MERGED_MANIFEST_H

#include "merge.h"
#include "shard_set.h"

/* is_ended: all files are there. missing: of merge.h. FM_IO; FM_NO_MEMORY. */
fm_status merged_manifest_write(const shard_set *set, const fm_merge_desc *desc,
                                const fm_text_list *missing, bool is_ended, fm_error *err);

/* Whether the directory may take a merge of the plan: it is not there, is empty, or holds an
 * earlier merge of this plan. FM_INVALID. */
fm_status merged_manifest_expect(const char *directory, const char *plan, fm_error *err);

#endif
