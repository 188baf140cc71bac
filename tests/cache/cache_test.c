/* What is kept is found again, or is not there: whatever lies in the folder, whoever else uses it.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <dirent.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/text.h"
#include "cache/cache.h"

enum { BYTES = 100, PROGRAM = 7 };

typedef struct place {
    char folder[32];
    fm_cache cache;
} place;

static void make_place(place *at)
{
    snprintf(at->folder, sizeof at->folder, "/tmp/fm-cache-XXXXXX");
    assert_non_null(mkdtemp(at->folder));
    cache_open(&at->cache, at->folder, PROGRAM);
}

static void remove_place(const place *at)
{
    char command[64];
    snprintf(command, sizeof command, "rm -r %s", at->folder);
    assert_int_equal(system(command), 0);
}

static cache_key key_of(const fm_cache *cache, cache_kind kind, uint64_t number)
{
    cache_key key = cache_key_begin(cache, kind);
    cache_key_add_number(&key, number);
    return key;
}

static void fill(unsigned char bytes[BYTES], int number)
{
    for (int i = 0; i < BYTES; i++)
        bytes[i] = (unsigned char)(i * 7 + number);
}

static void write_number(fm_cache *cache, int number)
{
    unsigned char bytes[BYTES];
    const cache_key key = key_of(cache, CACHE_SPIRV, (uint64_t)number);
    fill(bytes, number);
    cache_write(cache, CACHE_SPIRV, &key, bytes, sizeof bytes);
}

/* Whether it is there; if it is, it is right. */
static bool has_number(const fm_cache *cache, int number)
{
    unsigned char bytes[BYTES];
    void *found;
    size_t count;
    const cache_key key = key_of(cache, CACHE_SPIRV, (uint64_t)number);
    const bool is_there = cache_read(&found, &count, cache, CACHE_SPIRV, &key);
    fill(bytes, number);
    if (is_there) {
        assert_int_equal(count, sizeof bytes);
        assert_memory_equal(found, bytes, sizeof bytes);
    } else {
        assert_null(found);
    }
    free(found);
    return is_there;
}

/* The only file of a kind whose name does, or does not, end so. */
static void find_file(char path[400], const place *at, cache_kind kind, bool is_file)
{
    char folder[64];
    snprintf(folder, sizeof folder, "%s/%s", at->folder, cache_kinds[kind].name);
    DIR *opened = opendir(folder);
    assert_non_null(opened);
    path[0] = '\0';
    for (const struct dirent *entry; (entry = readdir(opened)) != NULL;)
        if (entry->d_name[0] != '.' && (strchr(entry->d_name, '.') != NULL) == is_file) {
            assert_string_equal(path, "");
            snprintf(path, 400, "%s/%s", folder, entry->d_name);
        }
    closedir(opened);
    assert_string_not_equal(path, "");
}

static void what_was_written_is_read_by_its_key_alone(void **state)
{
    place at;
    (void)state;
    make_place(&at);
    assert_false(has_number(&at.cache, 1));
    write_number(&at.cache, 1);
    assert_true(has_number(&at.cache, 1));
    assert_false(has_number(&at.cache, 2));
    fm_cache others;
    cache_open(&others, at.folder, PROGRAM + 1);
    assert_false(has_number(&others, 1));
    void *bytes;
    size_t count;
    const cache_key key = key_of(&at.cache, CACHE_PIPELINES, 1);
    assert_false(cache_read(&bytes, &count, &at.cache, CACHE_PIPELINES, &key));
    remove_place(&at);
}

static void keys_tell_parts_apart(void **state)
{
    const fm_cache cache = { .program = PROGRAM };
    cache_key parts[3];
    (void)state;
    for (int i = 0; i < 3; i++)
        parts[i] = cache_key_begin(&cache, CACHE_SPIRV);
    cache_key_add_text(&parts[0], "ab");
    cache_key_add_text(&parts[0], "c");
    cache_key_add_text(&parts[1], "a");
    cache_key_add_text(&parts[1], "bc");
    cache_key_add_text(&parts[2], "abc");
    assert_memory_not_equal(&parts[0], &parts[1], sizeof parts[0]);
    assert_memory_not_equal(&parts[0], &parts[2], sizeof parts[0]);
    assert_memory_not_equal(&parts[1], &parts[2], sizeof parts[0]);
}

static void damaged_files_are_not_there_and_are_replaced(void **state)
{
    char path[400];
    char *good = NULL;
    size_t count;
    place at;
    (void)state;
    make_place(&at);
    write_number(&at.cache, 1);
    find_file(path, &at, CACHE_SPIRV, false);
    assert_int_equal(text_read_file(&good, &count, path, 4096, NULL), FM_OK);
    for (size_t i = 0; i < count; i++) {
        assert_int_equal(text_write_file(path, good, i, NULL), FM_OK); /* cut */
        assert_false(has_number(&at.cache, 1));
        for (int bit = 0; bit < 8; bit++) {
            good[i] ^= (char)(1 << bit);
            assert_int_equal(text_write_file(path, good, count, NULL), FM_OK);
            assert_false(has_number(&at.cache, 1));
            good[i] ^= (char)(1 << bit);
        }
    }
    write_number(&at.cache, 1);
    assert_true(has_number(&at.cache, 1));
    free(good);
    remove_place(&at);
}

static void longer_files_folders_pipes_and_links_are_not_read(void **state)
{
    char path[400], moved[410];
    place at;
    (void)state;
    make_place(&at);
    write_number(&at.cache, 1);
    find_file(path, &at, CACHE_SPIRV, false);
    FILE *file = fopen(path, "ab");
    assert_non_null(file);
    assert_int_equal(fputc(0, file), 0);
    fclose(file);
    assert_false(has_number(&at.cache, 1));
    write_number(&at.cache, 1);
    snprintf(moved, sizeof moved, "%s.moved", path);
    assert_int_equal(rename(path, moved), 0);
    assert_int_equal(symlink(moved, path), 0);
    assert_false(has_number(&at.cache, 1));
    unlink(path);
    assert_int_equal(mkfifo(path, 0600), 0);
    assert_false(has_number(&at.cache, 1));
    unlink(path);
    assert_int_equal(mkdir(path, 0700), 0);
    assert_false(has_number(&at.cache, 1));
    write_number(&at.cache, 1); /* a folder is in its way: nothing happens */
    assert_false(has_number(&at.cache, 1));
    remove_place(&at);
}

static void without_a_folder_nothing_is_kept(void **state)
{
    fm_cache none, unwritable;
    (void)state;
    cache_open(&none, "", PROGRAM);
    cache_open(&unwritable, "/proc/nowhere", PROGRAM);
    write_number(&none, 1);
    write_number(&unwritable, 1);
    assert_false(has_number(&none, 1));
    assert_false(has_number(&unwritable, 1));
    cache_close(&none);
    cache_close(&unwritable);
}

static void the_environment_says_where_it_lies(void **state)
{
    char folder[FM_PATH_MAX_BYTES];
    (void)state;
    setenv("HOME", "/home/a", 1);
    setenv("XDG_CACHE_HOME", "relative", 1);
    unsetenv("FRAGMARK_CACHE");
    cache_find_folder(folder);
    assert_string_equal(folder, "/home/a/.cache/fragmark");
    setenv("XDG_CACHE_HOME", "/c", 1);
    cache_find_folder(folder);
    assert_string_equal(folder, "/c/fragmark");
    setenv("FRAGMARK_CACHE", "/own", 1);
    cache_find_folder(folder);
    assert_string_equal(folder, "/own");
    setenv("FRAGMARK_CACHE", "off", 1);
    cache_find_folder(folder);
    assert_string_equal(folder, "");
    unsetenv("FRAGMARK_CACHE");
    unsetenv("XDG_CACHE_HOME");
    unsetenv("HOME");
    cache_find_folder(folder);
    assert_string_equal(folder, "");
}

static void files_are_found_whole(void **state)
{
    char source[64], copy[64], kept[400];
    char *bytes = NULL;
    size_t count;
    place at;
    (void)state;
    make_place(&at);
    snprintf(source, sizeof source, "%s/source", at.folder);
    snprintf(copy, sizeof copy, "%s/copy", at.folder);
    assert_int_equal(text_write_file(source, "0123456789", 10, NULL), FM_OK);
    const cache_key key = key_of(&at.cache, CACHE_TRUTH, 1);
    assert_false(cache_read_file(copy, &at.cache, CACHE_TRUTH, &key));
    cache_write_file(&at.cache, CACHE_TRUTH, &key, source);
    for (int i = 0; i < 2; i++) { /* the second time it replaces itself */
        assert_true(cache_read_file(copy, &at.cache, CACHE_TRUTH, &key));
        assert_int_equal(text_read_file(&bytes, &count, copy, 100, NULL), FM_OK);
        assert_int_equal(count, 10);
        assert_memory_equal(bytes, "0123456789", 10);
        free(bytes);
    }
    unlink(copy);
    unlink(source);
    find_file(kept, &at, CACHE_TRUTH, true);
    assert_int_equal(text_write_file(kept, "0123456780", 10, NULL), FM_OK);
    assert_false(cache_read_file(copy, &at.cache, CACHE_TRUTH, &key));
    assert_int_equal(text_write_file(kept, "012345678", 9, NULL), FM_OK);
    assert_false(cache_read_file(copy, &at.cache, CACHE_TRUTH, &key));
    unlink(kept);
    assert_false(cache_read_file(copy, &at.cache, CACHE_TRUTH, &key));
    assert_int_equal(access(copy, F_OK), -1);
    assert_int_equal(text_write_file(source, "9876", 4, NULL), FM_OK);
    cache_write_file(&at.cache, CACHE_TRUTH, &key, source);
    assert_true(cache_read_file(copy, &at.cache, CACHE_TRUTH, &key));
    remove_place(&at);
}

static void what_was_used_least_recently_goes(void **state)
{
    enum { FILES = 5, LARGE = (4 << 20) - 64 };
    static const struct timespec steps[FILES] = {
        { .tv_sec = 1000 }, { .tv_sec = 2000 }, { .tv_sec = 3000 }, { .tv_sec = 4000 }
    };
    char path[400];
    void *found;
    size_t count;
    place at;
    (void)state;
    make_place(&at);
    char *bytes = calloc(LARGE, 1);
    assert_non_null(bytes);
    for (int i = 0; i < FILES; i++) {
        const cache_key key = key_of(&at.cache, CACHE_PLUGINS, (uint64_t)i);
        cache_write(&at.cache, CACHE_PLUGINS, &key, bytes, LARGE);
        snprintf(path, sizeof path, "%s/plugins/%016llx%016llx", at.folder,
                 (unsigned long long)key.words[1], (unsigned long long)key.words[0]);
        const struct timespec times[] = { steps[i], steps[i] };
        if (i + 1 < FILES)
            assert_int_equal(utimensat(AT_FDCWD, path, times, 0), 0);
    }
    const cache_key first = key_of(&at.cache, CACHE_PLUGINS, 0);
    assert_true(cache_read(&found, &count, &at.cache, CACHE_PLUGINS, &first)); /* used again */
    free(found);
    cache_close(&at.cache);
    cache_open(&at.cache, at.folder, PROGRAM);
    const bool wanted[FILES] = { true, false, false, true, true }; /* 12 of 16 MiB stay */
    for (int i = 0; i < FILES; i++) {
        const cache_key key = key_of(&at.cache, CACHE_PLUGINS, (uint64_t)i);
        assert_int_equal(cache_read(&found, &count, &at.cache, CACHE_PLUGINS, &key), wanted[i]);
        free(found);
    }
    assert_int_equal(cache_measure(at.folder, CACHE_PLUGINS).files, 3);
    free(bytes);
    remove_place(&at);
}

static void what_is_too_large_is_not_kept(void **state)
{
    place at;
    void *found;
    size_t count;
    (void)state;
    make_place(&at);
    const size_t large = (size_t)cache_kinds[CACHE_PLUGINS].most_bytes / 4 + 1;
    void *bytes = calloc(large, 1);
    assert_non_null(bytes);
    const cache_key key = key_of(&at.cache, CACHE_PLUGINS, 1);
    cache_write(&at.cache, CACHE_PLUGINS, &key, bytes, large);
    assert_false(cache_read(&found, &count, &at.cache, CACHE_PLUGINS, &key));
    free(bytes);
    remove_place(&at);
}

/* Processes that write and read the same few entries, and one that damages them. */
static void many_processes_find_right_contents_or_none(void **state)
{
    enum { PROCESSES = 6, ROUNDS = 400, NUMBERS = 4 };
    char path[400];
    place at;
    (void)state;
    make_place(&at);
    for (int process = 0; process < PROCESSES; process++) {
        if (fork() != 0)
            continue;
        for (int round = 0; round < ROUNDS; round++) {
            const int number = (round * 5 + process) % NUMBERS;
            const cache_key key = key_of(&at.cache, CACHE_SPIRV, (uint64_t)number);
            snprintf(path, sizeof path, "%s/spirv/%016llx%016llx", at.folder,
                     (unsigned long long)key.words[1], (unsigned long long)key.words[0]);
            if (process == 0)
                (void)!truncate(path, round % 170);
            else if ((round + process) % 3 == 0)
                write_number(&at.cache, number);
            else
                (void)has_number(&at.cache, number);
        }
        _exit(0); /* an assertion that failed has left by another way */
    }
    for (int process = 0; process < PROCESSES; process++) {
        int how = -1;
        assert_true(wait(&how) > 0);
        assert_true(WIFEXITED(how) && WEXITSTATUS(how) == 0);
    }
    remove_place(&at);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_was_written_is_read_by_its_key_alone),
        cmocka_unit_test(keys_tell_parts_apart),
        cmocka_unit_test(damaged_files_are_not_there_and_are_replaced),
        cmocka_unit_test(longer_files_folders_pipes_and_links_are_not_read),
        cmocka_unit_test(without_a_folder_nothing_is_kept),
        cmocka_unit_test(the_environment_says_where_it_lies),
        cmocka_unit_test(files_are_found_whole),
        cmocka_unit_test(what_was_used_least_recently_goes),
        cmocka_unit_test(what_is_too_large_is_not_kept),
        cmocka_unit_test(many_processes_find_right_contents_or_none),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
