/* Which cases a folder has something of, and how one of them is chosen. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "inspect/kept_cases.h"

static const char summary[] =
    "schema,case_id,status,message,method,device,feed,scene,n,k,seed,options\n"
    "1,aa11,ok,\"two, \"\"quoted\"\"\",kb,vulkan,raster,layers,32,8,1,layout=pixel\n"
    "1,bb22,ok,,kb,vulkan,raster,layers,32,16,1,layout=pixel\n"
    "1,cc33,wrong_image,,exact,osmesa,raster,bunny,9,,1,\n"
    "1,dd44,ok,,null,vulkan,raster,layers,32,,1,\n";
static const char *const names[] = { "bb22.truth",  "aa11.fragments",      "aa11.truth",
                                     "cc33.frames", "cc33.frames.partial", "notes.txt",
                                     ".fragments" };

typedef struct place {
    char folder[32];
} place;

static void write_in(const place *at, const char *name, const char *text)
{
    char path[96];
    snprintf(path, sizeof path, "%s/%s", at->folder, name);
    assert_int_equal(text_write_file(path, text, strlen(text), NULL), FM_OK);
}

static void open_place(place *at, const char *csv)
{
    char path[96];
    snprintf(at->folder, sizeof at->folder, "/tmp/fm-cases-XXXXXX");
    assert_non_null(mkdtemp(at->folder));
    snprintf(path, sizeof path, "%s/kept", at->folder);
    assert_int_equal(mkdir(path, 0777), 0);
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        snprintf(path, sizeof path, "kept/%s", names[i]);
        write_in(at, path, "");
    }
    if (csv != NULL)
        write_in(at, "summary.csv", csv);
}

static void close_place(const place *at)
{
    char path[96];
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        snprintf(path, sizeof path, "%s/kept/%s", at->folder, names[i]);
        unlink(path);
    }
    snprintf(path, sizeof path, "%s/kept", at->folder);
    assert_int_equal(rmdir(path), 0);
    snprintf(path, sizeof path, "%s/summary.csv", at->folder);
    unlink(path);
    assert_int_equal(rmdir(at->folder), 0);
}

static void cases_have_what_the_summary_says_of_them(void **state)
{
    place at;
    kept_cases cases = { 0 };
    (void)state;
    open_place(&at, summary);
    assert_int_equal(kept_cases_read(&cases, at.folder, NULL), FM_OK);
    assert_int_equal(cases.count, 3); /* of dd44 nothing is kept */
    assert_string_equal(cases.cases[0].facts[KEPT_CASE_ID], "aa11");
    assert_int_equal(cases.cases[0].kinds, 1u << KEPT_FRAGMENTS | 1u << KEPT_TRUTH);
    assert_string_equal(cases.cases[0].facts[KEPT_OPTIONS], "layout=pixel");
    assert_string_equal(cases.cases[1].facts[KEPT_K], "16");
    assert_int_equal(cases.cases[1].kinds, 1u << KEPT_TRUTH);
    assert_string_equal(cases.cases[2].facts[KEPT_STATUS], "wrong_image");
    assert_int_equal(cases.cases[2].kinds, 1u << KEPT_FRAMES);
    kept_cases_free(&cases);
    close_place(&at);
}

static void a_run_without_a_summary_has_its_ids(void **state)
{
    static const char *const texts[] = {
        NULL, "", "\n", "schema,case_id", "case_id\naa11\n\n\"", ",,,\n,\n"
    };
    (void)state;
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++) {
        place at;
        kept_cases cases = { 0 };
        open_place(&at, texts[i]);
        assert_int_equal(kept_cases_read(&cases, at.folder, NULL), FM_OK);
        assert_int_equal(cases.count, 3);
        assert_string_equal(cases.cases[2].facts[KEPT_CASE_ID], "cc33");
        assert_string_equal(cases.cases[2].facts[KEPT_METHOD], "");
        kept_cases_free(&cases);
        close_place(&at);
    }
}

/* Whether the one case is chosen, or what the refusal says. */
static void choose(const char *const wanted[KEPT_FACT_COUNT], const char *id, const char *words)
{
    place at;
    kept_cases cases = { 0 };
    const kept_case *chosen;
    fm_error err = { .message = "" };
    open_place(&at, summary);
    assert_int_equal(kept_cases_read(&cases, at.folder, NULL), FM_OK);
    const fm_status status = kept_cases_choose(&chosen, &cases, wanted, &err);
    assert_int_equal(status, id != NULL ? FM_OK : FM_INVALID);
    if (id != NULL)
        assert_string_equal(chosen->facts[KEPT_CASE_ID], id);
    else if (strstr(err.message, words) == NULL)
        fail_msg("'%s' does not say '%s'", err.message, words);
    kept_cases_free(&cases);
    close_place(&at);
}

static void one_case_is_chosen_by_what_it_is(void **state)
{
    (void)state;
    choose((const char *[KEPT_FACT_COUNT]){ [KEPT_METHOD] = "exact" }, "cc33", NULL);
    choose((const char *[KEPT_FACT_COUNT]){ [KEPT_CASE_ID] = "bb22" }, "bb22", NULL);
    choose((const char *[KEPT_FACT_COUNT]){ [KEPT_METHOD] = "kb" }, NULL,
           "2 kept cases fit: which one?\n  --case aa11  kb raster layers k=8 seed=1 layout=pixel\n"
           "  --case bb22");
    choose((const char *[KEPT_FACT_COUNT]){ NULL }, NULL, "3 kept cases fit");
}

static void what_no_case_is_is_answered_with_the_nearest(void **state)
{
    (void)state;
    choose((const char *[KEPT_FACT_COUNT]){ [KEPT_METHOD] = "exakt" }, NULL,
           "no kept case has method 'exakt'; the nearest is 'exact'");
    choose((const char *[KEPT_FACT_COUNT]){ [KEPT_CASE_ID] = "aa12" }, NULL,
           "the nearest is 'aa11'");
    choose((const char *[KEPT_FACT_COUNT]){ [KEPT_METHOD] = "kb", [KEPT_DEVICE] = "osmesa" }, NULL,
           "no kept case has device 'osmesa'; there is 'vulkan'");
}

static void a_folder_without_kept_files_says_how_to_have_them(void **state)
{
    char folder[] = "/tmp/fm-cases-XXXXXX";
    kept_cases cases = { 0 };
    fm_error err = { 0 };
    (void)state;
    assert_non_null(mkdtemp(folder));
    assert_int_equal(kept_cases_read(&cases, folder, &err), FM_INVALID);
    assert_non_null(strstr(err.message, "fragmark run --keep"));
    kept_cases_free(&cases);
    assert_int_equal(rmdir(folder), 0);
    assert_int_equal(kept_cases_read(&cases, folder, &err), FM_IO);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(cases_have_what_the_summary_says_of_them),
        cmocka_unit_test(a_run_without_a_summary_has_its_ids),
        cmocka_unit_test(one_case_is_chosen_by_what_it_is),
        cmocka_unit_test(what_no_case_is_is_answered_with_the_nearest),
        cmocka_unit_test(a_folder_without_kept_files_says_how_to_have_them),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
