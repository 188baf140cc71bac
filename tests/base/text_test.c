#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include <cmocka.h>

#include "base/path.h"
#include "base/text.h"
#include "base/yaml_tree.h"

/* A file in a folder of its own. */
typedef struct place {
    char folder[64], file[96];
} place;

static void place_create(place *at)
{
    strcpy(at->folder, "/tmp/fragmark-text-XXXXXX");
    assert_non_null(mkdtemp(at->folder));
    snprintf(at->file, sizeof at->file, "%s/a.txt", at->folder);
}

static void place_destroy(const place *at)
{
    unlink(at->file);
    assert_int_equal(rmdir(at->folder), 0); /* nothing else was left there */
}

static void text_add_grows(void **state)
{
    (void)state;
    fm_text text = { 0 };
    for (int i = 0; i < 1000; i++)
        text_add(&text, "%d,", i);
    text_add_raw(&text, "end", 3);
    assert_false(text.failed);
    assert_int_equal(text.length, 10 + 90 * 2 + 900 * 3 + 1000 + 3);
    assert_string_equal(text.bytes + text.length - 7, "999,end");
    text_free(&text);
    assert_null(text.bytes);
}

static void text_add_failure_sticks(void **state)
{
    (void)state;
    fm_text text = { 0 };
    text_add(&text, "kept");
    text_add_raw(&text, "", SIZE_MAX / 2);
    text_add(&text, "lost");
    assert_true(text.failed);
    assert_string_equal(text.bytes, "kept");
    text_free(&text);
}

static void text_file_round_trip_keeps_nul_bytes(void **state)
{
    (void)state;
    place at;
    fm_error err;
    char *bytes = NULL;
    size_t count = 0;
    place_create(&at);
    assert_int_equal(text_write_file(at.file, "a\0b", 3, &err), FM_OK);
    assert_int_equal(text_read_file(&bytes, &count, at.file, 3, &err), FM_OK);
    assert_int_equal(count, 3);
    assert_memory_equal(bytes, "a\0b\0", 4);
    free(bytes);
    place_destroy(&at);
}

static void text_read_file_takes_empty_files(void **state)
{
    (void)state;
    place at;
    fm_error err;
    char *bytes = NULL;
    size_t count = 1;
    place_create(&at);
    assert_int_equal(text_write_file(at.file, "", 0, &err), FM_OK);
    assert_int_equal(text_read_file(&bytes, &count, at.file, 3, &err), FM_OK);
    assert_int_equal(count, 0);
    assert_string_equal(bytes, "");
    free(bytes);
    place_destroy(&at);
}

static void text_read_file_refuses_what_is_above_the_limit(void **state)
{
    (void)state;
    place at;
    fm_error err;
    char *bytes = NULL;
    size_t count = 0;
    place_create(&at);
    assert_int_equal(text_write_file(at.file, "1234", 4, &err), FM_OK);
    assert_int_equal(text_read_file(&bytes, &count, at.file, 3, &err), FM_INVALID);
    assert_non_null(strstr(err.message, at.file));
    assert_null(bytes);
    place_destroy(&at);
}

static void text_files_name_the_path_that_fails(void **state)
{
    (void)state;
    fm_error err;
    char *bytes = NULL;
    size_t count = 0;
    assert_int_equal(text_read_file(&bytes, &count, "/nowhere/a", 9, &err), FM_IO);
    assert_non_null(strstr(err.message, "/nowhere/a"));
    assert_int_equal(text_read_file(&bytes, &count, "/tmp", 9, &err), FM_INVALID);
    assert_int_equal(text_write_file("/nowhere/a", "x", 1, &err), FM_IO);
    assert_non_null(strstr(err.message, "/nowhere/a"));
}

static void text_list_holds_copies_and_ends_with_null(void **state)
{
    (void)state;
    char name[] = "a";
    fm_text_list list = { 0 }, copy = { 0 };
    assert_null(text_list_items(&list)[0]);
    for (int i = 0; i < 20; i++, name[0]++) {
        assert_true(text_list_add(&list, name));
        assert_null(text_list_items(&list)[list.count]);
    }
    assert_true(text_list_add_all(&copy, &list) && text_list_add_all(&copy, NULL));
    assert_int_equal(copy.count, 20);
    assert_string_equal(text_list_items(&copy)[19], "t");
    assert_true(text_list_has(&copy, "a") && !text_list_has(&copy, "u"));
    assert_false(text_list_has(NULL, "a"));
    text_list_free(&list);
    text_list_free(&copy);
}

static void text_shared_keeps_one_copy(void **state)
{
    (void)state;
    char text[] = "a/mesh.obj";
    const char *first = text_shared(text);
    assert_string_equal(first, "a/mesh.obj");
    text[0] = 'b';
    const char *other = text_shared(text);
    assert_string_equal(first, "a/mesh.obj");
    assert_string_equal(other, "b/mesh.obj");
    text[0] = 'a';
    assert_ptr_equal(text_shared(text), first);
    text[0] = '\0';
    assert_ptr_equal(text_shared(text), text_shared(""));
}

static void text_nearest_needs_half_of_the_word(void **state)
{
    (void)state;
    const char *const names[] = { "kplus-array", "kplus-heap", "kb" };
    assert_string_equal(text_nearest("kplus-arry", names, 3), "kplus-array");
    assert_string_equal(text_nearest("kplus_heap", names, 3), "kplus-heap");
    assert_string_equal(text_nearest("kc", names, 3), "kb");
    assert_null(text_nearest("wboit", names, 3));
    assert_null(text_nearest("", names, 3));
    assert_null(text_nearest("x", names, 0));
}

static void text_is_utf8_knows_what_json_refuses(void **state)
{
    (void)state;
    static const char *const good[] = { "",       "a",          "\u00e9",
                                        "\u20ac", "\U0001F600", "\xF4\x8F\xBF\xBF" };
    static const char *const bad[] = { "\x80",
                                       "\xC3",
                                       "a\xE9",
                                       "\xC0\xAF",
                                       "\xE0\x80\xAF",
                                       "\xED\xA0\x80",
                                       "\xE2\x82",
                                       "\xF4\x90\x80\x80",
                                       "\xF8\x88\x80\x80\x80",
                                       "\xF0\x80\x80\x80",
                                       "\xFF" };
    for (size_t i = 0; i < sizeof good / sizeof good[0]; i++)
        assert_true(text_is_utf8(good[i]));
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++)
        if (text_is_utf8(bad[i]))
            fail_msg("bad[%zu] is taken", i);
}

static void text_make_utf8_replaces_only_bad_bytes(void **state)
{
    (void)state;
    char text[] = "caf\xE9 caf\u00e9 \xE2\x82";
    text_make_utf8(text);
    assert_string_equal(text, "caf? caf\u00e9 ??");
}

static void text_to_u64_takes_whole_texts_in_range(void **state)
{
    (void)state;
    uint64_t value = 7;
    assert_true(text_to_u64(&value, "18446744073709551615"));
    assert_true(value == UINT64_MAX);
    const char *const bad[] = { "", "4x", " 4", "4 ", "-1", "+1", "18446744073709551616", "0x4" };
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++)
        assert_false(text_to_u64(&value, bad[i]));
    assert_true(value == UINT64_MAX);
}

static void text_to_double_takes_finite_decimals(void **state)
{
    (void)state;
    double value = 0;
    assert_true(text_to_double(&value, "-2.5e-1"));
    assert_true(value > -0.2501 && value < -0.2499);
    const char *const bad[] = { "", "inf", "nan", "0x1p3", "1e999", "1 ", " 1", "1,5", "e", "4x" };
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++)
        assert_false(text_to_double(&value, bad[i]));
}

static void text_from_double_is_short_and_exact(void **state)
{
    (void)state;
    char text[32];
    text_from_double(text, 0.1);
    assert_string_equal(text, "0.1");
    text_from_double(text, 854);
    assert_string_equal(text, "854");
    double again = 0;
    text_from_double(text, 1.0 / 3.0);
    assert_true(text_to_double(&again, text));
    assert_memory_equal(&again, &(double){ 1.0 / 3.0 }, sizeof again);
}

static void path_make_temporary_names_what_is_to_blame(void **state)
{
    (void)state;
    char path[FM_PATH_MAX_BYTES], long_name[2 * FM_PATH_MAX_BYTES] = "/";
    fm_error err = { 0 };
    setenv("TMPDIR", "/nowhere", 1);
    assert_int_equal(path_make_temporary(path, "x", &err), FM_IO);
    assert_string_equal(err.message, "TMPDIR: /nowhere: no temporary folder can be made there: No "
                                     "such file or directory");
    assert_string_equal(path, "");
    memset(long_name + 1, 'a', sizeof long_name - 2);
    setenv("TMPDIR", long_name, 1);
    assert_int_equal(path_make_temporary(path, "x", &err), FM_INVALID);
    setenv("TMPDIR", "", 1); /* as if it were not set */
    assert_int_equal(path_make_temporary(path, "x", &err), FM_OK);
    assert_int_equal(strncmp(path, "/tmp/x-", 7), 0);
    assert_int_equal(rmdir(path), 0);
    unsetenv("TMPDIR");
}

static void path_beside_keeps_absolute_names(void **state)
{
    (void)state;
    char path[16];
    assert_true(path_beside(path, sizeof path, "a/b.yml", "c.obj"));
    assert_string_equal(path, "a/c.obj");
    assert_true(path_beside(path, sizeof path, "a/b.yml", "/c.obj"));
    assert_string_equal(path, "/c.obj");
    assert_true(path_beside(path, sizeof path, "b.yml", "c.obj"));
    assert_string_equal(path, "c.obj");
    assert_false(path_beside(path, sizeof path, "a/b.yml", "0123456789abcdef"));
}

static fm_status parse(fm_yaml **root, const char *text, fm_error *err)
{
    return yaml_tree_parse(root, text, strlen(text), "f.yml", err);
}

static void yaml_tree_keeps_order_and_lines(void **state)
{
    (void)state;
    fm_yaml *root = NULL;
    fm_error err;
    assert_int_equal(parse(&root, "# c\nk: [4, 8]\nmap:\n  a: x y\n", &err), FM_OK);
    assert_int_equal(root->count, 2);
    const fm_yaml *k = yaml_tree_find(root, "k"), *map = yaml_tree_find(root, "map");
    assert_int_equal(k->kind, FM_YAML_LIST);
    assert_int_equal(k->line, 2);
    assert_string_equal(k->items[1].text, "8");
    assert_int_equal(map->line, 3);
    assert_string_equal(yaml_tree_find(map, "a")->text, "x y");
    assert_int_equal(yaml_tree_find(map, "a")->line, 4);
    assert_null(yaml_tree_find(k, "a"));
    yaml_tree_free(root);
}

static void yaml_tree_reads_nothing_as_an_empty_mapping(void **state)
{
    (void)state;
    fm_yaml *root = NULL;
    fm_error err;
    assert_int_equal(parse(&root, "# only a comment\n", &err), FM_OK);
    assert_int_equal(root->kind, FM_YAML_MAP);
    assert_int_equal(root->count, 0);
    yaml_tree_free(root);
}

static void yaml_tree_refuses_with_the_line(void **state)
{
    (void)state;
    static const struct {
        const char *text, *message;
    } bad[] = {
        { "a: 1\nb: 2\na: 3\n", "f.yml:3: 'a' stands on line 1" },
        { "a: &x [1]\nb: *x\n", "f.yml:2: an anchor is used again" },
        { "a: &x [*x]\n", "f.yml:1: an anchor is used again" },
        { "a: [1\nb: 2\n", "f.yml:2: " },
        { "a: 1\n---\nb: 2\n", "f.yml:2: a second document" },
        { "? [a]\n: 1\n", "f.yml:1: a key that is not a plain text" },
        { "a: \"x\\0y\"\n", "f.yml:1: a NUL byte" },
        { "a: [[[[[[[[[[[[[[[[[1]]]]]]]]]]]]]]]]]\n", "f.yml:1: nested deeper" },
    };
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        fm_yaml *root = NULL;
        fm_error err;
        assert_int_equal(parse(&root, bad[i].text, &err), FM_INVALID);
        assert_null(root);
        if (strstr(err.message, bad[i].message) == NULL)
            fail_msg("'%s' lacks '%s'", err.message, bad[i].message);
    }
}

static void yaml_tree_refuses_mappings_that_are_too_wide(void **state)
{
    (void)state;
    fm_yaml *root = NULL;
    fm_error err;
    fm_text text = { 0 };
    for (int i = 0; i <= FM_YAML_MAX_KEYS; i++)
        text_add(&text, "k%d: 1\n", i);
    assert_int_equal(parse(&root, text.bytes, &err), FM_INVALID);
    assert_non_null(strstr(err.message, "f.yml:1025: more than 1024 keys"));
    text_free(&text);
}

/* Of a mebibyte each: composed first, 50 kB of the first one took 13 s. */
static void yaml_tree_refuses_what_is_deep_or_long_at_once(void **state)
{
    (void)state;
    static const struct {
        const char *start, *again, *message;
    } bad[] = {
        { "a: 1\nb: ", "[", "f.yml:2: nested deeper than 16" },
        { "a:\n", " [\n", "f.yml:17: nested deeper than 16" },
        { "a: ", "{a: ", "f.yml:1: nested deeper than 16" },
        { "", "- ", "f.yml:1: nested deeper than 16" },
        { "", "? ", "f.yml:1: a key that is not a plain text" },
        { "", "[{a: ", "f.yml:1: nested deeper than 16" },
        { "a: [", "x, ", "f.yml:1: more than 65536 values" },
        { "a: [", "[], ", "f.yml:1: more than 65536 values" },
        { "a: [", "*x, ", "f.yml:1: an anchor is used again" },
        { "a: ", "&x ", "f.yml:1: " },
        { "a: 1\n...\n", "%YAML 1.1\r\n", "f.yml:11: more than 8 directives" },
        { "a: \"", "x", "f.yml:" },
    };
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        fm_yaml *root = NULL;
        fm_error err = { 0 };
        fm_text text = { 0 };
        text_add(&text, "%s", bad[i].start);
        while (text.length < FM_YAML_MAX_BYTES)
            text_add(&text, "%s", bad[i].again);
        const clock_t before = clock();
        const fm_status status = parse(&root, text.bytes, &err);
        const double seconds = (double)(clock() - before) / CLOCKS_PER_SEC;
        yaml_tree_free(root);
        text_free(&text);
        if (status != FM_INVALID || strstr(err.message, bad[i].message) == NULL || seconds > 1.0)
            fail_msg("row %zu: %d, %.2f s, '%s' lacks '%s'", i, status, seconds, err.message,
                     bad[i].message);
    }
}

static void yaml_tree_read_names_the_missing_file(void **state)
{
    (void)state;
    fm_yaml *root = NULL;
    fm_error err;
    assert_int_equal(yaml_tree_read(&root, "/nowhere/a.yml", &err), FM_IO);
    assert_non_null(strstr(err.message, "/nowhere/a.yml"));
}

static void error_prefix_puts_a_colon_and_takes_no_error(void **state)
{
    (void)state;
    fm_error err = { 0 };
    fm_fail(&err, FM_IO, "no such file");
    assert_int_equal(fm_error_prefix(&err, "scene %d", 7), FM_IO);
    assert_string_equal(err.message, "scene 7: no such file");
    assert_int_equal(fm_error_prefix(NULL, "scene %d", 7), FM_INVALID);
}

static void a_refusal_has_a_reason_that_a_prefix_keeps_and_a_failure_clears(void **state)
{
    (void)state;
    fm_error err = { 0 };
    assert_int_equal(fm_refuse(&err, FM_REASON_DEVICE_LIMIT, "%d bytes", 9), FM_UNSUPPORTED);
    assert_int_equal(fm_error_prefix(&err, "kb"), FM_UNSUPPORTED);
    assert_int_equal(err.status, FM_UNSUPPORTED);
    assert_int_equal(err.reason, FM_REASON_DEVICE_LIMIT);
    assert_string_equal(err.message, "kb: 9 bytes");
    fm_fail(&err, FM_IO, "no such file");
    assert_int_equal(err.reason, FM_REASON_NONE);
    assert_int_equal(fm_refuse(NULL, FM_REASON_SCENE, "nobody hears"), FM_UNSUPPORTED);
}

static void only_what_was_given_becomes_a_refusal(void **state)
{
    (void)state;
    static const fm_status given[] = { FM_INVALID, FM_IO },
                           others[] = { FM_OK, FM_NO_MEMORY, FM_DEVICE_LOST };
    fm_error err = { 0 };
    for (size_t i = 0; i < 2; i++) {
        fm_fail(&err, given[i], "a.obj:7: no");
        assert_int_equal(fm_error_refuse(&err, given[i], FM_REASON_SCENE), FM_UNSUPPORTED);
        assert_int_equal(err.status, FM_UNSUPPORTED);
        assert_int_equal(err.reason, FM_REASON_SCENE);
        assert_string_equal(err.message, "a.obj:7: no");
        assert_int_equal(fm_error_refuse(NULL, given[i], FM_REASON_SCENE), FM_UNSUPPORTED);
    }
    for (size_t i = 0; i < 3; i++) {
        fm_fail(&err, others[i], "it stays");
        assert_int_equal(fm_error_refuse(&err, others[i], FM_REASON_SCENE), others[i]);
        assert_int_equal(err.reason, FM_REASON_NONE);
    }
    fm_refuse(&err, FM_REASON_LOOPS, "so does another reason");
    assert_int_equal(fm_error_refuse(&err, FM_UNSUPPORTED, FM_REASON_SCENE), FM_UNSUPPORTED);
    assert_int_equal(err.reason, FM_REASON_LOOPS);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(error_prefix_puts_a_colon_and_takes_no_error),
        cmocka_unit_test(a_refusal_has_a_reason_that_a_prefix_keeps_and_a_failure_clears),
        cmocka_unit_test(only_what_was_given_becomes_a_refusal),
        cmocka_unit_test(text_add_grows),
        cmocka_unit_test(text_add_failure_sticks),
        cmocka_unit_test(text_file_round_trip_keeps_nul_bytes),
        cmocka_unit_test(text_read_file_takes_empty_files),
        cmocka_unit_test(text_read_file_refuses_what_is_above_the_limit),
        cmocka_unit_test(text_files_name_the_path_that_fails),
        cmocka_unit_test(text_list_holds_copies_and_ends_with_null),
        cmocka_unit_test(text_shared_keeps_one_copy),
        cmocka_unit_test(text_nearest_needs_half_of_the_word),
        cmocka_unit_test(text_is_utf8_knows_what_json_refuses),
        cmocka_unit_test(text_make_utf8_replaces_only_bad_bytes),
        cmocka_unit_test(text_to_u64_takes_whole_texts_in_range),
        cmocka_unit_test(text_to_double_takes_finite_decimals),
        cmocka_unit_test(text_from_double_is_short_and_exact),
        cmocka_unit_test(path_make_temporary_names_what_is_to_blame),
        cmocka_unit_test(path_beside_keeps_absolute_names),
        cmocka_unit_test(yaml_tree_keeps_order_and_lines),
        cmocka_unit_test(yaml_tree_reads_nothing_as_an_empty_mapping),
        cmocka_unit_test(yaml_tree_refuses_with_the_line),
        cmocka_unit_test(yaml_tree_refuses_mappings_that_are_too_wide),
        cmocka_unit_test(yaml_tree_refuses_what_is_deep_or_long_at_once),
        cmocka_unit_test(yaml_tree_read_names_the_missing_file),
    };
    return cmocka_run_group_tests_name("text", tests, NULL, NULL);
}
