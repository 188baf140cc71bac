/* A pack: a folder of results with checksums, versions, and what is needed to measure it again, for
 * whoever reviews it.
 *
 *   NAME/...          the results as they are, but for what only running launches need
 *   NAME/pack.json    the version that packed them, the commands, and all files with size and XXH3
 *   NAME/README       the same for people: what was measured where, plugins, scenes, how to repeat
 * it
 *
 * The room pack makes packs (pack.h), and says what of one is damaged, and what is another here
 * (verify.h). XXH3 finds damage, not malice: a forger can make a file's hash again. */
#ifndef FM_PACK_H
#define FM_PACK_H

#include <stdint.h>

#include "base/path.h"

#define FM_PACK_FILE "pack.json"

typedef struct fm_pack_desc {
    const char *directory; /* results of a run, a reproduction or a merge */
    const char *output; /* NAME.tar, .tar.gz, .tgz, .tar.xz or .tar.zst; else a folder. Is made */
} fm_pack_desc;

typedef struct fm_pack_result {
    size_t files;
    uint64_t bytes;
    char id[17];        /* XXH3 of pack.json: the same results under the same name have the same */
    bool is_unfinished; /* the run had not ended */
} fm_pack_result;

/* Makes it beside the output and renames it: there is a whole pack or none. FM_INVALID: no folder
 * of results; the output is there. FM_IO: a file cannot be read or written, tar failed.
 * FM_UNSUPPORTED: no tar. FM_NO_MEMORY. */
fm_status pack_make(fm_pack_result *result, const fm_pack_desc *desc, fm_error *err);

#endif
