#include "remembered.h"

#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "code/code.h"
#include "fragmark/method.h"

static const off_t plugin_max_bytes = (off_t)64 << 20; /* larger ones are not remembered */

/* false: it is no file that can be read, or too large. */
static bool digest_of(uint64_t *digest, const char *path)
{
    struct stat info;
    *digest = 0;
    if (stat(path, &info) == 0 && info.st_size <= plugin_max_bytes)
        *digest = code_hash_file(path);
    return *digest != 0;
}

void remembered_open(fm_cache *from, const char *folder, const char *program)
{
    char users[FM_PATH_MAX_BYTES];
    uint64_t digest;
    if (folder == NULL)
        cache_find_folder(users);
    const char *chosen = folder != NULL ? folder : users;
    cache_open(from, digest_of(&digest, program) ? chosen : "", digest);
}

answer_key answer_key_of(const fm_cache *from, const char *plugin)
{
    answer_key key = { .key = cache_key_begin(from, CACHE_PLUGINS) };
    uint64_t digest;
    if (from->folder[0] == '\0')
        return key;
    char *whole = realpath(plugin, NULL);
    key.is_known = digest_of(&digest, plugin);
    cache_key_add_text(&key.key, whole != NULL ? whole : plugin);
    cache_key_add_number(&key.key, digest);
    cache_key_add_number(&key.key, FM_ABI);
    free(whole);
    return key;
}

static bool is_lasting(const answer_head *head)
{
    return head->kind == ANSWER_DESCRIBED || head->kind == ANSWER_REFUSED;
}

bool remembered_read(answer *found, const fm_cache *from, const answer_key *key)
{
    void *bytes;
    size_t count;
    if (!key->is_known || !cache_read(&bytes, &count, from, CACHE_PLUGINS, &key->key))
        return false;
    bool is_good = count >= sizeof found->head && count <= sizeof *found;
    if (is_good) {
        memcpy(found, bytes, count);
        is_good = is_lasting(&found->head) && found->head.count == count - sizeof found->head;
    }
    free(bytes);
    return is_good;
}

/* Only what follows from the bytes alone is worth remembering. */
void remembered_write(fm_cache *to, const char *plugin, const answer_key *key, const answer *about)
{
    if (!key->is_known || !is_lasting(&about->head) || about->head.count > sizeof about->bytes)
        return;
    const answer_key now = answer_key_of(to, plugin);
    if (now.is_known && memcmp(&now.key, &key->key, sizeof now.key) == 0)
        cache_write(to, CACHE_PLUGINS, &key->key, about, sizeof about->head + about->head.count);
}
