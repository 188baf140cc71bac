/* Answers that were given before, in the user's cache (cache/cache.h). What a file says is believed
 * as little as what a process says. */
#ifndef FM_DESCRIBE_REMEMBERED_H
#define FM_DESCRIBE_REMEMBERED_H

#include <stdbool.h>

#include "answer.h"
#include "cache/cache.h"

/* What an answer depends on: the plugin's path and bytes, the program's, and the ABI. */
typedef struct answer_key {
    cache_key key;
    bool is_known; /* false: the file cannot be read, or is no file; it is not remembered */
} answer_key;

/* folder, program: as fm_describer has them. */
void remembered_open(fm_cache *from, const char *folder, const char *program);
answer_key answer_key_of(const fm_cache *from, const char *plugin);
/* false: nothing is remembered of these bytes. */
bool remembered_read(answer *found, const fm_cache *from, const answer_key *key);
/* Remembers an answer, if the plugin still has the bytes of the key. */
void remembered_write(fm_cache *to, const char *plugin, const answer_key *key, const answer *about);

#endif
