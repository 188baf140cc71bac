#include "cache.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/text.h"
#include "code/code.h"

static const char suffix[] = ".description";
static const off_t plugin_max_bytes = (off_t)64 << 20; /* larger ones are not remembered */

/* In front of the answer in a file. */
typedef struct cache_head {
    char magic[16];
    uint64_t key[2];
    uint64_t digest; /* of the answer's bytes: a file that was cut says so */
    answer_head answer;
} cache_head;

static const char magic[16] = "fragmark cache";

/* false: it is no file that can be read, or too large. */
static bool digest_of(uint64_t *digest, const char *path)
{
    struct stat info;
    *digest = 0;
    if (stat(path, &info) == 0 && info.st_size <= plugin_max_bytes)
        *digest = code_hash_file(path);
    return *digest != 0;
}

/* Folders of the path that are not there are made, the last one too; an absolute path. */
static bool make_folders(char *path)
{
    for (char *c = path + 1; *c != '\0'; c++) {
        if (*c != '/')
            continue;
        *c = '\0';
        mkdir(path, 0700);
        *c = '/';
    }
    return mkdir(path, 0700) == 0 || errno == EEXIST;
}

static bool name_folder(char folder[FM_PATH_MAX_BYTES], const char *given)
{
    const char *base = getenv("XDG_CACHE_HOME"), *home = getenv("HOME");
    int length = -1;
    if (given != NULL)
        length = snprintf(folder, FM_PATH_MAX_BYTES, "%s", given);
    else if (base != NULL && base[0] == '/')
        length = snprintf(folder, FM_PATH_MAX_BYTES, "%s/fragmark/plugins", base);
    else if (home != NULL && home[0] == '/')
        length = snprintf(folder, FM_PATH_MAX_BYTES, "%s/.cache/fragmark/plugins", home);
    return length > 0 && length < FM_PATH_MAX_BYTES - 32; /* with a file's name behind it */
}

void cache_open(cache *from, const char *folder, const char *program)
{
    *from = (cache){ 0 };
    if (!name_folder(from->folder, folder) || !make_folders(from->folder) ||
        !digest_of(&from->program, program))
        from->folder[0] = '\0';
}

cache_key cache_key_of(const cache *of, const char *plugin)
{
    const uint64_t words[] = { of->program, FM_ABI };
    cache_key key = { 0 };
    if (of->folder[0] == '\0')
        return key;
    key.is_known = digest_of(&key.words[0], plugin);
    key.words[1] = code_hash(words, sizeof words);
    return key;
}

static void name_file(char path[FM_PATH_MAX_BYTES + 32], const cache *of, const char *plugin)
{
    char *whole = realpath(plugin, NULL);
    const char *name = whole != NULL ? whole : plugin;
    snprintf(path, FM_PATH_MAX_BYTES + 32, "%s/%016llx%s", of->folder,
             (unsigned long long)code_hash(name, strlen(name)), suffix);
    free(whole);
}

static bool is_about(const cache_head *head, const cache_key *key, const answer *found)
{
    return memcmp(head->magic, magic, sizeof magic) == 0 &&
           memcmp(head->key, key->words, sizeof head->key) == 0 &&
           (head->answer.kind == ANSWER_DESCRIBED || head->answer.kind == ANSWER_REFUSED) &&
           head->answer.count <= sizeof found->bytes;
}

bool cache_read(answer *found, const cache *from, const char *plugin, const cache_key *key)
{
    char path[FM_PATH_MAX_BYTES + 32];
    cache_head head;
    struct stat info;
    if (!key->is_known)
        return false;
    name_file(path, from, plugin);
    const int file = open(path, O_RDONLY | O_NONBLOCK | O_CLOEXEC | O_NOFOLLOW);
    if (file < 0)
        return false;
    const bool is_good =
        fstat(file, &info) == 0 && S_ISREG(info.st_mode) &&
        read(file, &head, sizeof head) == (ssize_t)sizeof head && is_about(&head, key, found) &&
        read(file, found->bytes, head.answer.count) == (ssize_t)head.answer.count &&
        code_hash(found->bytes, head.answer.count) == head.digest;
    close(file);
    found->head = head.answer;
    return is_good;
}

/* Another process sees the old file or the new one. */
static void replace(const char *path, const cache_head *head, const answer *about)
{
    char partial[FM_PATH_MAX_BYTES + 64];
    snprintf(partial, sizeof partial, "%s.XXXXXX", path);
    const int file = mkostemp(partial, O_CLOEXEC);
    if (file < 0)
        return;
    const bool is_whole =
        write(file, head, sizeof *head) == (ssize_t)sizeof *head &&
        write(file, about->bytes, about->head.count) == (ssize_t)about->head.count;
    if (close(file) != 0 || !is_whole || rename(partial, path) != 0)
        unlink(partial);
}

/* Only what follows from the bytes alone is worth remembering. */
void cache_write(const cache *to, const char *plugin, const cache_key *key, const answer *about)
{
    char path[FM_PATH_MAX_BYTES + 32];
    const bool is_lasting =
        about->head.kind == ANSWER_DESCRIBED || about->head.kind == ANSWER_REFUSED;
    if (!key->is_known || !is_lasting || about->head.count > sizeof about->bytes)
        return;
    const cache_key now = cache_key_of(to, plugin);
    if (!now.is_known || memcmp(now.words, key->words, sizeof now.words) != 0)
        return;
    cache_head head = { .key = { key->words[0], key->words[1] },
                        .digest = code_hash(about->bytes, about->head.count),
                        .answer = about->head };
    memcpy(head.magic, magic, sizeof magic);
    name_file(path, to, plugin);
    replace(path, &head, about);
}

/* A file of the cache. */
typedef struct cached {
    struct timespec written;
    char name[64];
} cached;

static int compare_age(const void *left, const void *right)
{
    const struct timespec *a = &((const cached *)left)->written,
                          *b = &((const cached *)right)->written;
    if (a->tv_sec != b->tv_sec)
        return a->tv_sec < b->tv_sec ? -1 : 1;
    return (a->tv_nsec > b->tv_nsec) - (a->tv_nsec < b->tv_nsec);
}

static bool add_file(cached **files, size_t *count, int folder, const char *name)
{
    struct stat info;
    if (strstr(name, suffix) == NULL || strlen(name) >= sizeof(*files)->name ||
        fstatat(folder, name, &info, AT_SYMLINK_NOFOLLOW) != 0)
        return true;
    cached *grown = realloc(*files, (*count + 1) * sizeof *grown);
    if (grown == NULL)
        return false;
    *files = grown;
    grown[*count].written = info.st_mtim;
    memcpy(grown[(*count)++].name, name, strlen(name) + 1);
    return true;
}

void cache_prune(const cache *of)
{
    cached *files = NULL;
    size_t count = 0;
    struct dirent *item;
    DIR *folder = of->folder[0] != '\0' ? opendir(of->folder) : NULL;
    if (folder == NULL)
        return;
    while ((item = readdir(folder)) != NULL &&
           add_file(&files, &count, dirfd(folder), item->d_name))
        continue;
    if (count > CACHE_FILES_MAX) {
        qsort(files, count, sizeof *files, compare_age);
        for (size_t i = 0; i < count - CACHE_FILES_MAX; i++)
            unlinkat(dirfd(folder), files[i].name, 0);
    }
    free(files);
    closedir(folder);
}
