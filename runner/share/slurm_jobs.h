/* The two jobs of `fragmark slurm`: tried, written, submitted. */
#ifndef FM_SLURM_JOBS_H
#define FM_SLURM_JOBS_H

#include "cli/cli.h"
#include "slurm_script.h"

typedef struct slurm_files {
    char shards[FM_PATH_MAX_BYTES], merge[FM_PATH_MAX_BYTES], logs[FM_PATH_MAX_BYTES];
} slurm_files;

/* Expands the plan here, so that what is wrong is told now, and not by N tasks of a night. Figures
 * have no plan to look at. Returns an exit code. */
int slurm_check_plan(const fm_cli *cli, const slurm_desc *desc);
/* FM_INVALID: the directory cannot be, or holds something else; FM_IO. */
fm_status slurm_write_files(slurm_files *files, const slurm_desc *desc, fm_error *err);
/* Returns an exit code. */
int slurm_submit(const fm_cli *cli, const slurm_files *files, const slurm_desc *desc);

#endif
