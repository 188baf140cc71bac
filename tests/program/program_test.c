/* Builds, and programs that are asked before they measure for this one. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmocka.h>

#include "base/text.h"
#include "program/handshake.h"

typedef struct folder {
    char path[64], program[96];
} folder;

static void make_folder(folder *made, const char *inside)
{
    char path[128];
    snprintf(made->path, sizeof made->path, "/tmp/fragmark-program-XXXXXX");
    assert_non_null(mkdtemp(made->path));
    snprintf(path, sizeof path, "%s/%s", made->path, inside);
    assert_int_equal(path_make_folders(path, NULL), FM_OK);
    snprintf(made->program, sizeof made->program, "%s/fragmark", made->path);
}

static void remove_folder(const folder *made)
{
    char command[128];
    snprintf(command, sizeof command, "rm -r '%s'", made->path);
    assert_int_equal(system(command), 0);
}

static void write_script(const char *path, const char *script)
{
    assert_int_equal(text_write_file(path, script, strlen(script), NULL), FM_OK);
    assert_int_equal(chmod(path, 0755), 0);
}

static void a_folder_of_plugins_has_no_program(void **state)
{
    folder made;
    fm_build build;
    fm_error err = { 0 };
    (void)state;
    make_folder(&made, "kb");
    write_script(made.program, "#!/bin/sh\n"); /* beside plugins, not beside methods/ */
    assert_int_equal(build_find(&build, made.path, NULL), FM_OK);
    assert_string_equal(build.methods, made.path);
    assert_string_equal(build.program, "");
    remove_folder(&made);
    assert_int_equal(build_find(&build, made.path, &err), FM_IO);
    assert_non_null(strstr(err.message, made.path));
}

static void a_build_has_methods_and_perhaps_a_program(void **state)
{
    folder made;
    fm_build build;
    char methods[96];
    (void)state;
    make_folder(&made, "methods");
    snprintf(methods, sizeof methods, "%s/methods", made.path);
    assert_int_equal(build_find(&build, made.path, NULL), FM_OK);
    assert_string_equal(build.methods, methods);
    assert_string_equal(build.program, "");
    write_script(made.program, "#!/bin/sh\n");
    assert_int_equal(build_find(&build, made.path, NULL), FM_OK);
    assert_string_equal(build.program, made.program);
    assert_int_equal(chmod(made.program, 0644), 0); /* it cannot be executed */
    assert_int_equal(build_find(&build, made.path, NULL), FM_OK);
    assert_string_equal(build.program, "");
    remove_folder(&made);
}

static void an_installed_prefix_has_its_program_in_bin(void **state)
{
    folder made;
    fm_build build;
    char program[128], bin[96];
    (void)state;
    make_folder(&made, "lib/fragmark/methods");
    snprintf(bin, sizeof bin, "%s/bin", made.path);
    snprintf(program, sizeof program, "%s/fragmark", bin);
    assert_int_equal(mkdir(bin, 0755), 0);
    write_script(program, "#!/bin/sh\n");
    assert_int_equal(build_find(&build, made.path, NULL), FM_OK);
    assert_non_null(strstr(build.methods, "/lib/fragmark/methods"));
    assert_string_equal(build.program, program);
    remove_folder(&made);
}

static void this_program_measures_for_itself(void **state)
{
    bool is_foreign;
    fm_build build = { .program = "" };
    fm_error err = { 0 };
    (void)state;
    snprintf(build.program, sizeof build.program, "%s", getenv("FRAGMARK_PROGRAM"));
    if (handshake_ask(&is_foreign, &build, &err) != FM_OK)
        fail_msg("%s", err.message);
    assert_false(is_foreign);
    assert_true(build.commit[0] != '\0' && build.compiler[0] != '\0');
}

/* A program that answers as this one does, but for what sed changes. */
static void foreign_programs_are_refused_with_both_names(void **state)
{
    static const char answer[] = "#!/bin/sh\n"
                                 "out=$(mktemp)\n"
                                 "\"$FRAGMARK_PROGRAM\" protocol \"$out\"\n"
                                 "sed '%s' \"$out\" >\"$2\"\n"
                                 "rm \"$out\"\n";
    static const struct {
        const char *change, *words;
    } rows[] = {
        { "s/\"fragmark\":\"[^\"]*\"/\"fragmark\":\"0.0.1\"/", "it is fragmark 0.0.1, and not " },
        { "s/\"protocol\":1/\"protocol\":2/", "it speaks protocol 2, and not 1" },
        { "s/\"descriptions\":\"/&0/", "descriptors of methods have other fields" },
        { "s/\"width_px\"/\"breadth\"/", "it does not know the key 'width_px'" },
        { "s/\"metrics\":\\[/&\"joy\",/", "it measures 'joy'" },
        { "s/.*/no JSON/", "does not answer `fragmark protocol`" },
    };
    folder made;
    fm_build build;
    char script[512];
    (void)state;
    make_folder(&made, "methods");
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        bool is_foreign;
        fm_error err = { 0 };
        snprintf(script, sizeof script, answer, rows[i].change);
        write_script(made.program, script);
        assert_int_equal(build_find(&build, made.path, NULL), FM_OK);
        assert_int_equal(handshake_ask(&is_foreign, &build, &err), FM_INVALID);
        assert_true(is_foreign);
        if (strstr(err.message, rows[i].words) == NULL ||
            strstr(err.message, made.program) == NULL || strstr(err.message, FM_VERSION) == NULL)
            fail_msg("row %zu: '%s' lacks '%s'", i, err.message, rows[i].words);
    }
    remove_folder(&made);
}

static void programs_that_do_not_answer_are_refused(void **state)
{
    static const char *const scripts[] = {
        "#!/bin/sh\necho 'no command' >&2\nexit 2\n", /* as programs of before */
        "#!/bin/sh\nkill -SEGV $$\n",
        "no program at all\n",
    };
    folder made;
    fm_build build;
    (void)state;
    make_folder(&made, "methods");
    for (size_t i = 0; i < sizeof scripts / sizeof scripts[0]; i++) {
        bool is_foreign;
        fm_error err = { 0 };
        write_script(made.program, scripts[i]);
        assert_int_equal(build_find(&build, made.path, NULL), FM_OK);
        assert_int_equal(handshake_ask(&is_foreign, &build, &err), FM_INVALID);
        assert_true(is_foreign);
        assert_non_null(strstr(err.message, made.program));
    }
    remove_folder(&made);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_folder_of_plugins_has_no_program),
        cmocka_unit_test(a_build_has_methods_and_perhaps_a_program),
        cmocka_unit_test(an_installed_prefix_has_its_program_in_bin),
        cmocka_unit_test(this_program_measures_for_itself),
        cmocka_unit_test(foreign_programs_are_refused_with_both_names),
        cmocka_unit_test(programs_that_do_not_answer_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
