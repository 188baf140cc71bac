/* `fragmark dump`: what a run kept, as CSV.
 *
 * The room inspect looks inside what `run --keep` left (truth/kept_file.h): which cases there are,
 * their fragments against truth, and the wrong tiles of sequences. It measures nothing. */
#ifndef FM_DUMP_H
#define FM_DUMP_H

#include "cli/cli.h"

fm_command inspect_dump;

#endif
