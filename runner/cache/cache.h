/* What launches and runs need again: files in the user's cache, each found by a hash of all that it
 * follows from. SPIR-V follows from GLSL, what a driver made of a pipeline from SPIR-V and the
 * driver, a truth from a scene and a device.
 *
 * Nothing here is a result: without it the same comes out, later. So no function fails. What cannot
 * be read, is damaged, or is of something else is not there; what cannot be written is not kept. A
 * file is believed only if its head, its size and the digest of its content are right. Digests find
 * accidents: who may write into the folder is trusted as the user is.
 *
 * Any number of processes may use one folder. A file takes its name when it is whole, and is never
 * changed. Each kind has a folder and a size; when more was written, those that were used least
 * recently are removed. The folder may be removed at any time. */
#ifndef FM_CACHE_H
#define FM_CACHE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include "base/path.h"

typedef enum cache_kind {
    CACHE_PLUGINS, /* what plugins say of themselves: describe/ */
    CACHE_SPIRV,
    CACHE_PIPELINES, /* data of VkPipelineCache */
    CACHE_TRUTH,
    CACHE_KIND_COUNT
} cache_kind;

typedef struct cache_kind_info {
    const char *name;    /* "spirv": of its folder */
    uint64_t most_bytes; /* all its files together; one has a quarter at most */
} cache_kind_info;
extern const cache_kind_info cache_kinds[CACHE_KIND_COUNT];

/* Zero: there is none; nothing is found and nothing kept. */
typedef struct fm_cache {
    char folder[FM_PATH_MAX_BYTES]; /* "": none */
    uint64_t program;               /* hash of the program, which all keys hold: what it makes may
                                       change with it, and so does the compiler that is in it */
    bool has_written[CACHE_KIND_COUNT];
} fm_cache;

/* The user's: FRAGMARK_CACHE if that is an absolute path; $XDG_CACHE_HOME/fragmark;
 * $HOME/.cache/fragmark. "": FRAGMARK_CACHE is "off", or nothing says where. A variable that is no
 * absolute path counts as not set. */
void cache_find_folder(char folder[FM_PATH_MAX_BYTES]);
/* folder "" or too long: none. Nothing is made before something is written. */
void cache_open(fm_cache *cache, const char *folder, uint64_t program);
/* Removes what is too much, of the kinds that were written to. */
void cache_close(fm_cache *cache);

/* Grows from what it is made of, in order. */
typedef struct cache_key {
    uint64_t words[2];
} cache_key;

cache_key cache_key_begin(const fm_cache *cache, cache_kind kind);
void cache_key_add(cache_key *key, const void *bytes, size_t count);
void cache_key_add_text(cache_key *key, const char *text);
void cache_key_add_number(cache_key *key, uint64_t number);

/* What was kept under the key. true: the caller frees *bytes. */
bool cache_read(void **bytes, size_t *count, const fm_cache *cache, cache_kind kind,
                const cache_key *key);
void cache_write(fm_cache *cache, cache_kind kind, const cache_key *key, const void *bytes,
                 size_t count);

/* The same of whole files, which may be larger than memory. The file at `path` is another name of
 * the cache's where the disk allows that, and must not be changed; else it is a copy. path is
 * replaced, whole, or untouched. */
bool cache_read_file(const char *path, const fm_cache *cache, cache_kind kind,
                     const cache_key *key);
void cache_write_file(fm_cache *cache, cache_kind kind, const cache_key *key, const char *path);

/* What is there. */
typedef struct cache_size {
    uint64_t files, bytes;
} cache_size;
cache_size cache_measure(const char *folder, cache_kind kind);

#endif
