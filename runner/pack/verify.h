/* What of a pack is damaged, and what on this machine is another than where it was measured. */
#ifndef FM_PACK_VERIFY_H
#define FM_PACK_VERIFY_H

#include "base/text.h"
#include "pack.h"
#include "plugin/plugin.h"

/* Starts as {0}. Sentences that begin with the file or the fact. */
typedef struct fm_verify_result {
    fm_text_list damaged;     /* size or content is another, or it is a link */
    fm_text_list missing;     /* of the pack, and not there */
    fm_text_list unlisted;    /* there, and not of the pack */
    fm_text_list differences; /* here: version, code, scenes, machine */
    size_t files;             /* that are as they were packed */
    uint64_t bytes;
    char id[17];
    bool is_foreign; /* no pack, or one whose list cannot be read */
} fm_verify_result;

/* path: a pack, as an archive or a folder. plugins: those of this machine, for the differences.
 * FM_INVALID: not there; or, with is_foreign, no pack. FM_IO: it cannot be read or unpacked; TMPDIR
 * has no room. FM_UNSUPPORTED: no tar. FM_NO_MEMORY. verify_free also then. */
fm_status verify_pack(fm_verify_result *result, const char *path, const fm_plugin_list *plugins,
                      fm_error *err);
void verify_free(fm_verify_result *result);

#endif
