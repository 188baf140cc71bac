/* What a row was measured by, and what of it changed. */
#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmocka.h>

#include "base/clock.h"
#include "code/code_json.h"
#include "code/code_now.h"
#include "code/codes.h"

static fm_code sample(void)
{
    fm_code code = { .program = 1, .driver = 2 };
    code_add(&code, FM_CODE_OF_METHOD, "store.glsl", 3);
    code_add(&code, FM_CODE_OF_METHOD, "kb.so", 4);
    code_add(&code, FM_CODE_OF_FLOOR, "store.glsl", 5);
    return code;
}

static void hash_of_a_part_hangs_on_what_was_read_not_on_the_order(void **state)
{
    (void)state;
    fm_code one = sample(), other = { .program = 1, .driver = 2 };
    code_add(&other, FM_CODE_OF_FLOOR, "store.glsl", 5);
    code_add(&other, FM_CODE_OF_METHOD, "kb.so", 4);
    code_add(&other, FM_CODE_OF_METHOD, "store.glsl", 3);
    code_add(&other, FM_CODE_OF_METHOD, "store.glsl", 3); /* once more, and the same */
    for (int part = 0; part < FM_CODE_PART_COUNT; part++)
        assert_true(code_part(&one, (fm_code_part)part) == code_part(&other, (fm_code_part)part));
    assert_true(code_part(&one, FM_CODE_PLUGIN) != code_part(&one, FM_CODE_SHADERS));
    code_free(&one);
    code_free(&other);
}

static void hash_of_a_file_is_that_of_its_bytes(void **state)
{
    (void)state;
    static char bytes[200000];
    char path[] = "/tmp/fragmark-code-XXXXXX";
    const int fd = mkstemp(path);
    assert_true(fd >= 0);
    assert_true(code_hash_file(path) == code_hash("", 0));
    for (size_t i = 0; i < sizeof bytes; i++)
        bytes[i] = (char)(i * i >> 3);
    assert_int_equal(write(fd, bytes, sizeof bytes), sizeof bytes);
    assert_true(code_hash_file(path) == code_hash(bytes, sizeof bytes));
    close(fd);
    unlink(path);
    assert_true(code_hash_file(path) == 0);
    assert_true(code_hash_file("/") == 0);
}

/* An editor, or a build, at work. */
static void file_that_shrinks_while_it_is_hashed_harms_nobody(void **state)
{
    (void)state;
    char path[] = "/tmp/fragmark-code-XXXXXX";
    const int fd = mkstemp(path);
    assert_true(fd >= 0);
    const pid_t writer = fork();
    if (writer == 0)
        alarm(5);
    while (writer == 0)
        if (ftruncate(fd, 8 << 20) != 0 || ftruncate(fd, 0) != 0)
            _exit(1);
    for (const double end = clock_s() + 0.3; clock_s() < end;)
        assert_true(code_hash_file(path) != 0);
    kill(writer, SIGKILL);
    waitpid(writer, NULL, 0);
    close(fd);
    unlink(path);
}

static void file_that_changed_between_two_reads_equals_neither(void **state)
{
    (void)state;
    fm_code code = { 0 };
    code_add(&code, FM_CODE_OF_METHOD, "store.glsl", 3);
    code_add(&code, FM_CODE_OF_METHOD, "store.glsl", 4);
    assert_int_equal(code.count, 1);
    assert_true(code.files[0].hash != 3 && code.files[0].hash != 4);
    code_free(&code);
}

static void code_comes_back_from_json(void **state)
{
    (void)state;
    fm_code code = sample(), back;
    json_t *json = code_to_json(&code);
    assert_true(code_from_json(&back, json));
    assert_int_equal(code_changes(NULL, &code, &back), 0);
    assert_int_equal(back.count, 3);
    assert_true(code_part(&code, FM_CODE_SHADERS) == code_part(&back, FM_CODE_SHADERS));
    assert_string_equal(json_string_value(json_object_get(json, "program")), "0000000000000001");
    json_decref(json);
    code_free(&code);
    code_free(&back);
}

static void json_of_another_form_is_refused(void **state)
{
    (void)state;
    static const char *const texts[] = {
        "[]",
        "{}",
        "{\"program\":1,\"driver\":\"\",\"files\":{\"method\":{},\"floor\":{}}}",
        "{\"program\":\"12\",\"driver\":\"\",\"files\":{\"method\":{},\"floor\":{}}}",
        "{\"program\":\"\",\"driver\":\"\",\"files\":{\"method\":{}}}",
        "{\"program\":\"\",\"driver\":\"\",\"files\":{\"method\":{\"a\":\"x\"},\"floor\":{}}}",
    };
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++) {
        fm_code code;
        json_t *json = json_loads(texts[i], 0, NULL);
        assert_non_null(json);
        assert_false(code_from_json(&code, json));
        json_decref(json);
        code_free(&code);
    }
}

static void changes_name_parts_and_files(void **state)
{
    (void)state;
    fm_text_list names = { 0 };
    fm_code then = sample(), now = { .program = 9, .driver = 2 };
    code_add(&now, FM_CODE_OF_METHOD, "kb.so", 4);
    code_add(&now, FM_CODE_OF_FLOOR, "store.glsl", 0); /* gone */
    code_add(&now, FM_CODE_OF_METHOD, "more.glsl", 7); /* nothing to compare with */
    assert_int_equal(code_changes(&names, &then, &now),
                     1u << FM_CODE_PROGRAM | 1u << FM_CODE_SHADERS);
    assert_int_equal(names.count, 1);
    assert_string_equal(names.items[0], "store.glsl");
    text_list_free(&names);
    code_free(&then);
    code_free(&now);
}

static void what_nobody_knows_is_no_change(void **state)
{
    (void)state;
    fm_code then = sample(), now = sample();
    then.driver = 0;
    assert_int_equal(code_changes(NULL, &then, &now), 0);
    then.driver = then.program; /* a part of the program: the program is what changes */
    now.program = now.driver = 9;
    assert_int_equal(code_changes(NULL, &then, &now), 1u << FM_CODE_PROGRAM);
    code_free(&then);
    code_free(&now);
}

/* FOLDER/kb/kb.so, store.glsl; FOLDER/other/other.glsl; FOLDER/common/lock.glsl */
typedef struct files {
    char folder[32], plugin[64], common[64];
    fm_code_places places;
} files;

static void write_file(const files *made, const char *name, const char *text)
{
    char path[96];
    snprintf(path, sizeof path, "%s/%s", made->folder, name);
    assert_int_equal(text_write_file(path, text, strlen(text), NULL), FM_OK);
}

static void make_files(files *made)
{
    static const char *const folders[] = { "kb", "other", "common" };
    char path[64];
    *made = (files){ .folder = "/tmp/fragmark-test-XXXXXX" };
    assert_non_null(mkdtemp(made->folder));
    for (size_t i = 0; i < 3; i++) {
        snprintf(path, sizeof path, "%s/%s", made->folder, folders[i]);
        assert_int_equal(mkdir(path, 0777), 0);
    }
    snprintf(made->plugin, sizeof made->plugin, "%s/kb/kb.so", made->folder);
    snprintf(made->common, sizeof made->common, "%s/common", made->folder);
    made->places =
        (fm_code_places){ .plugins = { made->plugin, "" }, .common = made->common, .program = 1 };
    write_file(made, "kb/kb.so", "machine code");
    write_file(made, "kb/store.glsl", "void store() {}");
    write_file(made, "other/other.glsl", "void other() {}");
    write_file(made, "common/lock.glsl", "void lock() {}");
}

static void remove_files(const files *made)
{
    static const char *const names[] = {
        "kb/kb.so", "kb/store.glsl", "other/other.glsl", "common/lock.glsl",
        "kb",       "other",         "common",           "",
    };
    char path[96];
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        snprintf(path, sizeof path, "%s/%s", made->folder, names[i]);
        assert_int_equal(remove(path), 0);
    }
}

/* Each file once, as a launch of a method might name it. */
static void edited_file_is_found_by_its_name(void **state)
{
    (void)state;
    static const char *const edits[][3] = {
        { "kb/kb.so", "kb.so", "plugin" },
        { "kb/store.glsl", "store.glsl", "shaders" },
        { "other/other.glsl", "other/other.glsl", "shaders" },
        { "common/lock.glsl", "common/lock.glsl", "shaders" },
    };
    static const char *const shaders[] = { "store.glsl", "other/other.glsl", NULL };
    files made;
    make_files(&made);
    for (size_t i = 0; i < sizeof edits / sizeof edits[0]; i++) {
        fm_code then = { 0 }, now = { 0 }, again = { 0 };
        fm_text_list names = { 0 };
        code_guess(&then, &made.places, shaders);
        assert_int_equal(then.count, 4);
        code_look_again(&now, &then, &made.places);
        assert_int_equal(code_changes(NULL, &then, &now), 0);
        write_file(&made, edits[i][0], edits[i][1]);
        code_look_again(&again, &then, &made.places);
        const uint32_t changes = code_changes(&names, &then, &again);
        assert_int_equal(names.count, 1);
        assert_string_equal(names.items[0], edits[i][1]);
        assert_int_equal(changes, 1u << (i == 0 ? FM_CODE_PLUGIN : FM_CODE_SHADERS));
        text_list_free(&names);
        code_free(&then);
        code_free(&now);
        code_free(&again);
    }
    remove_files(&made);
}

static void rows_share_codes_and_forget_them(void **state)
{
    (void)state;
    fm_codes codes;
    fm_code code = sample(), more = { .program = 1 };
    assert_int_equal(codes_create(&codes, 3, NULL), FM_OK);
    code_add(&more, FM_CODE_OF_METHOD, "common/emit.glsl", 8);
    assert_int_equal(codes_add(&codes, 0, &code, NULL), FM_OK);
    assert_int_equal(codes_add(&codes, 1, &code, NULL), FM_OK);
    assert_int_equal(codes.count, 1);
    assert_int_equal(codes_add(&codes, 1, &more, NULL), FM_OK);
    assert_int_equal(codes.count, 2);
    assert_int_equal(codes_of(&codes, 1)->count, 4); /* what both launches read */
    assert_int_equal(codes_of(&codes, 0)->count, 3);
    assert_null(codes_of(&codes, 2));
    assert_int_equal(codes_add(&codes, 2, NULL, NULL), FM_OK);
    assert_true(codes.rows[2].lacks_code);
    codes_forget(&codes, 2);
    codes_forget(&codes, 1);
    assert_false(codes.rows[2].lacks_code);
    assert_null(codes_of(&codes, 1));
    assert_int_equal(codes.rows[1].forgets, 1);
    assert_int_equal(codes.rows[1].launches, 0);
    codes_free(&codes);
    code_free(&code);
    code_free(&more);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(hash_of_a_part_hangs_on_what_was_read_not_on_the_order),
        cmocka_unit_test(hash_of_a_file_is_that_of_its_bytes),
        cmocka_unit_test(file_that_shrinks_while_it_is_hashed_harms_nobody),
        cmocka_unit_test(file_that_changed_between_two_reads_equals_neither),
        cmocka_unit_test(code_comes_back_from_json),
        cmocka_unit_test(json_of_another_form_is_refused),
        cmocka_unit_test(changes_name_parts_and_files),
        cmocka_unit_test(what_nobody_knows_is_no_change),
        cmocka_unit_test(edited_file_is_found_by_its_name),
        cmocka_unit_test(rows_share_codes_and_forget_them),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
