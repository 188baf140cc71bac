/* Builds of fragmark, and the programs in them: which one may measure for this one.
 *
 * The room program knows where the methods and the program of a build lie (this header), and asks
 * another program, before it measures anything, whether it speaks as this one does (handshake.h).
 * It measures nothing. */
#ifndef FM_PROGRAM_H
#define FM_PROGRAM_H

#include "base/error.h"
#include "base/path.h"

/* What a path means that a user names. */
typedef struct fm_build {
    char methods[FM_PATH_MAX_BYTES]; /* the folder of its plugins */
    char program[FM_PATH_MAX_BYTES]; /* absolute; "": it has none of its own */
    /* What that program says of itself; "": it was not asked. */
    char commit[64], compiler[128];
} fm_build;

/* PATH/methods where there is one (a build), with PATH/fragmark; or PATH/lib/fragmark/methods (an
 * installed prefix, a bundle), with PATH/bin/fragmark; else PATH itself, a folder of plugins, which
 * has no program. What cannot be executed is no program. FM_IO: PATH is no folder; FM_INVALID: too
 * long. */
fm_status build_find(fm_build *build, const char *path, fm_error *err);

#endif
