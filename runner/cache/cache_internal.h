/* Shared by the files of cache.h: cache.c (folders and keys), cache_entry.c (bytes under a key),
 * cache_file.c (files under a key), cache_size.c (how much there is, and what is too much). */
#ifndef FM_CACHE_INTERNAL_H
#define FM_CACHE_INTERNAL_H

#include "cache.h"

enum {
    CACHE_SHARE = 4,                            /* of the size of a kind, for one file */
    CACHE_ROOM_BYTES = FM_PATH_MAX_BYTES - 128, /* for the folder: names go behind it */
};

/* FOLDER/KIND/KEYENDING; with key NULL the folder of the kind. */
void cache_path(char path[FM_PATH_MAX_BYTES], const char *folder, cache_kind kind,
                const cache_key *key, const char *ending);

/* A file without a name that others look for, in the folder of the kind, which is made. -1: it
 * cannot be; partial is then "". */
int cache_open_partial(char partial[FM_PATH_MAX_BYTES], const fm_cache *cache, cache_kind kind);

/* The digest of what is left to be read. false: reading fails. */
bool cache_digest(uint64_t digest[2], uint64_t *bytes, int fd);

#endif
