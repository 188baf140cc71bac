/* `fragmark ab`, `gate` and `calibrate`: is it slower than before?
 *
 * The room regress holds these subcommands, their options and their exit codes. What they do is
 * done in the room ab. */
#ifndef FM_REGRESS_COMMANDS_H
#define FM_REGRESS_COMMANDS_H

#include "cli/cli.h"

fm_command regress_ab, regress_gate, regress_calibrate;
/* `fragmark calibrate device`; argv[0] is that. */
fm_command regress_calibrate_device;

#endif
