/* The batch scripts of `fragmark slurm`. */
#ifndef FM_SLURM_SCRIPT_H
#define FM_SLURM_SCRIPT_H

#include "base/text.h"

typedef struct slurm_desc {
    const char *program;         /* absolute path */
    const char *here;            /* folder that relative names in `words` are seen from */
    const char *directory;       /* absolute: DIRECTORY/shard-I, /merged, /logs */
    const fm_text_list *words;   /* "run" or "reproduce", and its arguments but -o and --shard */
    const fm_text_list *options; /* of sbatch, for both jobs */
    const fm_text_list *shard_options; /* of sbatch, for the shards */
    uint32_t shards;
    uint32_t lead_s;   /* TERM comes so long before the limit */
    uint32_t requeues; /* how often a shard that TERM stopped goes into the queue again */
    bool no_report;
} slurm_desc;

/* An array job, a task a shard. TERM reaches the program, which ends the journal; a task that is
 * put into the queue again continues. */
void slurm_add_shards(fm_text *text, const slurm_desc *desc);
/* The job that merges what there is, to be submitted with --dependency=afterany:ARRAY. */
void slurm_add_merge(fm_text *text, const slurm_desc *desc);
/* What a shard executes, but for its folder: scripts of one DIRECTORY must have the same. */
void slurm_add_command(fm_text *text, const slurm_desc *desc);

#endif
