/* One night, from its choice to its verdict. */
#ifndef FM_NIGHTLY_H
#define FM_NIGHTLY_H

#include "cli/cli.h"

/* `fragmark nightly [POLICY.yml]` */
fm_command nightly_command;

#endif
