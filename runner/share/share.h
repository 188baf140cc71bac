/* Subcommands for many machines and for other people: `merge` joins what shards measured, `slurm`
 * has a cluster measure and merge them; `pack` and `verify` are for whoever reviews results.
 *
 * The room share holds these subcommands, as cli holds the others: their options, their help and
 * their exit codes. */
#ifndef FM_SHARE_H
#define FM_SHARE_H

#include "cli/cli.h"

fm_command share_merge, share_slurm, share_pack, share_verify;

#endif
