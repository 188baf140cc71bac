/* Answers that were given before, in files: one for each path of a plugin, with the contents that
 * it is about. What a file says is believed as little as what a process says. A cache that cannot
 * be read or written is no failure: whatever is missing is asked for again. */
#ifndef FM_DESCRIBE_CACHE_H
#define FM_DESCRIBE_CACHE_H

#include <stdbool.h>

#include "answer.h"
#include "base/path.h"

enum { CACHE_FILES_MAX = 512 }; /* the oldest ones above that are removed */

/* What an answer depends on: the plugin's bytes, the program's, and the ABI. */
typedef struct cache_key {
    uint64_t words[2];
    bool is_known; /* false: the file cannot be read, or is no file; it is not remembered */
} cache_key;

typedef struct cache {
    char folder[FM_PATH_MAX_BYTES]; /* "": none */
    uint64_t program;               /* digest */
} cache;

/* folder, program: as fm_describer has them. */
void cache_open(cache *from, const char *folder, const char *program);
cache_key cache_key_of(const cache *of, const char *plugin);
/* false: nothing is remembered of these bytes. */
bool cache_read(answer *found, const cache *from, const char *plugin, const cache_key *key);
/* Remembers an answer, if the plugin still has the bytes of the key. */
void cache_write(const cache *to, const char *plugin, const cache_key *key, const answer *about);
/* Removes what is too much. */
void cache_prune(const cache *of);

#endif
