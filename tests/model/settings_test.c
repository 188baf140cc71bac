#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#include "model/feeds.h"
#include "model/settings.h"
#include "plan/plan.h"
#include "scene/scene_file.h"

static fm_settings defaults(void)
{
    fm_settings settings;
    settings_default(&settings);
    return settings;
}

static void set(fm_settings *settings, const char *name, const char *text)
{
    fm_error err = { 0 };
    if (settings_set(settings, key_find(name), text, &err) != FM_OK)
        fail_msg("%s", err.message);
}

static void settings_defaults_are_the_synthetic_scene(void **state)
{
    (void)state;
    fm_error err;
    fm_settings settings = defaults();
    assert_int_equal(settings.width_px, 854);
    assert_int_equal(settings.height_px, 480);
    assert_int_equal(settings.n, FM_NOT_GIVEN);
    assert_int_equal(settings_finish(&settings, &err), FM_OK);
    assert_int_equal(settings.r, 4);
    assert_int_equal(settings.n, 4 * settings.k);
}

static void keys_have_defaults_that_are_legal(void **state)
{
    (void)state;
    for (size_t i = 0; i < fm_key_count; i++) {
        fm_settings settings = { 0 };
        fm_error err = { 0 };
        if (settings_set(&settings, &fm_keys[i], fm_keys[i].fallback, &err) != FM_OK)
            fail_msg("%s", err.message);
        assert_ptr_equal(key_find(fm_keys[i].name), &fm_keys[i]);
    }
}

static void percent_is_written_with_its_sign(void **state)
{
    (void)state;
    static const char *const wrong[] = { "2",   "0%",  "-1%",  "101%", "%",
                                         "abc", "2%%", "nan%", "",     "2 %" };
    static const char *const right[] = { "2%", "0.01%", "0.1%", "100%", "none" };
    const fm_key *key = key_find("precision");
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        fm_settings settings = defaults();
        fm_error err = { 0 };
        assert_int_equal(settings_set(&settings, key, wrong[i], &err), FM_INVALID);
        assert_non_null(strstr(err.message, "is not a legal value; legal: 0.01%..100%"));
        assert_true(settings.precision_percent == 0.0);
    }
    for (size_t i = 0; i < sizeof right / sizeof right[0]; i++) {
        char text[FM_PATH_MAX_BYTES];
        fm_settings settings = defaults();
        set(&settings, "precision", right[i]);
        settings_text(text, &settings, key);
        assert_string_equal(text, right[i]);
    }
}

static void key_nearest_corrects_spelling(void **state)
{
    (void)state;
    assert_null(key_find("tesselation"));
    assert_string_equal(key_nearest("tesselation"), "tessellation");
    assert_string_equal(key_nearest("widht_px"), "width_px");
}

static void keys_help_names_every_key(void **state)
{
    (void)state;
    fm_text help = { 0 };
    keys_help(&help);
    for (size_t i = 0; i < fm_key_count; i++)
        assert_non_null(strstr(help.bytes, fm_keys[i].name));
    assert_non_null(strstr(help.bytes, "random|random-cell|ascending|descending|cell-major"));
    text_free(&help);
}

static void settings_set_refuses_and_says_what_is_legal(void **state)
{
    (void)state;
    static const struct {
        const char *key, *text, *message;
    } bad[] = {
        { "k", "0", "1..4096" },
        { "k", "4x", "k: '4x'" },
        { "k", "", "1..4096" },
        { "width_px", "none", "1..16384" },
        { "n", "65537", "0..65536" },
        { "pixel_density", "0", "pixel_density: '0'" },
        { "pixel_density", "1.01", "..1" },
        { "alpha", "-0.1", "0..1" },
        { "seed", "9223372036854775808", "0..9223372036854775807" },
        { "seed", "18446744073709551616", "0..9223372036854775807" },
        { "order", "sorted", "random|random-cell|ascending" },
        { "eye", "1 2", "\"x y z\"" },
        { "eye", "1 2 3 4", "\"x y z\"" },
        { "eye", "1 2 inf", "\"x y z\"" },
        { "eye", "1e309 0 0", "each any number" },
        { "mesh", "a\nb", "control characters" },
    };
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        fm_settings settings = defaults();
        fm_error err;
        assert_int_equal(settings_set(&settings, key_find(bad[i].key), bad[i].text, &err),
                         FM_INVALID);
        if (strstr(err.message, bad[i].message) == NULL)
            fail_msg("'%s' lacks '%s'", err.message, bad[i].message);
    }
}

static void settings_text_is_taken_back_by_set(void **state)
{
    (void)state;
    char text[FM_PATH_MAX_BYTES];
    fm_error err;
    fm_settings settings = defaults(), again = { 0 };
    set(&settings, "order", "cell-major");
    set(&settings, "pixel_density", "0.3333333333333333");
    set(&settings, "eye", "1e308 4649776.25 -1e308");
    set(&settings, "far_plane", "1e300");
    set(&settings, "eye", "1 -2.5 0.1");
    set(&settings, "seed", "9223372036854775807");
    assert_int_equal(settings_finish(&settings, &err), FM_OK);
    for (size_t i = 0; i < fm_key_count; i++) {
        settings_text(text, &settings, &fm_keys[i]);
        set(&again, fm_keys[i].name, text);
    }
    assert_memory_equal(&again, &settings, sizeof again);
}

static void settings_finish_accepts_finished_settings(void **state)
{
    (void)state;
    fm_error err;
    fm_settings settings = defaults();
    set(&settings, "k", "16");
    assert_int_equal(settings_finish(&settings, &err), FM_OK);
    assert_int_equal(settings_finish(&settings, &err), FM_OK);
    assert_int_equal(settings.n, 64);
    settings.k = 0; /* an A-buffer */
    assert_int_equal(settings_finish(&settings, &err), FM_OK);
    assert_int_equal(settings.n, 64);
}

static void settings_finish_takes_no_layers_when_told(void **state)
{
    (void)state;
    fm_error err;
    fm_settings settings = defaults();
    set(&settings, "n", "0");
    assert_int_equal(settings_finish(&settings, &err), FM_OK);
    assert_int_equal(settings.n, 0);
    assert_int_equal(settings.r, 0);
}

static void settings_finish_refuses_n_against_r(void **state)
{
    (void)state;
    fm_error err;
    fm_settings settings = defaults();
    set(&settings, "n", "10");
    set(&settings, "r", "2");
    assert_int_equal(settings_finish(&settings, &err), FM_INVALID);
    assert_non_null(strstr(err.message, "give n or r"));
}

static void settings_finish_needs_a_k_for_r(void **state)
{
    (void)state;
    fm_error err;
    fm_settings settings = defaults();
    set(&settings, "k", "none");
    assert_int_equal(settings_finish(&settings, &err), FM_INVALID);
    set(&settings, "n", "10");
    assert_int_equal(settings_finish(&settings, &err), FM_OK);
}

static void settings_finish_bounds_layers_and_fragments(void **state)
{
    (void)state;
    fm_error err;
    fm_settings settings = defaults();
    set(&settings, "r", "65536");
    assert_int_equal(settings_finish(&settings, &err), FM_INVALID);
    assert_non_null(strstr(err.message, "65536"));
    settings = defaults();
    set(&settings, "n", "65536");
    set(&settings, "width_px", "16384");
    set(&settings, "height_px", "16384");
    set(&settings, "pixel_density", "1");
    assert_int_equal(settings_finish(&settings, &err), FM_INVALID);
    assert_non_null(strstr(err.message, "2^40"));
}

static void settings_finish_judges_meshes(void **state)
{
    (void)state;
    fm_error err;
    fm_settings settings = defaults();
    set(&settings, "generator", "mesh");
    assert_int_equal(settings_finish(&settings, &err), FM_INVALID);
    assert_non_null(strstr(err.message, "needs a file"));
    set(&settings, "mesh", "a.obj");
    assert_int_equal(settings_finish(&settings, &err), FM_OK);
    assert_int_equal(settings.n, 0);
    set(&settings, "near_plane", "2");
    set(&settings, "far_plane", "1");
    assert_int_equal(settings_finish(&settings, &err), FM_INVALID);
    assert_non_null(strstr(err.message, "near_plane"));
}

static void scene_hash_mixes_only_what_the_generator_reads(void **state)
{
    (void)state;
    char a[17], b[17];
    fm_error err;
    fm_settings settings = defaults();
    assert_int_equal(settings_finish(&settings, &err), FM_OK);
    settings_scene_hash(a, &settings);
    assert_int_equal(strlen(a), 16);
    set(&settings, "zoom", "2");
    set(&settings, "lock", "interlock");
    settings.k = 16; /* n stays 32, which r = 2 gives as well */
    settings.r = 2;
    settings_scene_hash(b, &settings);
    assert_string_equal(a, b);
    set(&settings, "seed", "2");
    settings_scene_hash(b, &settings);
    assert_string_not_equal(a, b);
}

/* Hashes of the time before there were quiet keys: ids and truths of then stay. */
static void scene_hash_has_quiet_keys_only_where_they_are_set(void **state)
{
    (void)state;
    char hash[17];
    fm_error err;
    fm_settings settings = defaults();
    set(&settings, "n", "8");
    assert_int_equal(settings_finish(&settings, &err), FM_OK);
    settings_scene_hash(hash, &settings);
    assert_string_equal(hash, "31e3c850145acb2e");
    set(&settings, "depth", "reversed");
    settings_scene_hash(hash, &settings);
    assert_string_not_equal(hash, "31e3c850145acb2e");
}

static void scene_hash_changes_with_the_generators_version(void **state)
{
    (void)state;
    char a[17], b[17], next[17];
    fm_settings settings = defaults();
    set(&settings, "generator", "palace");
    const uint32_t version = generator_version(settings.generator);
    settings_scene_hash(a, &settings);
    settings_scene_hash_with(b, &settings, 0, version);
    settings_scene_hash_with(next, &settings, 0, version + 1);
    assert_string_equal(a, b);
    assert_string_not_equal(a, next);
}

/* They never end, or never begin. */
static void only_regular_files_are_digested(void **state)
{
    (void)state;
    uint64_t digest;
    fm_error err = { 0 };
    assert_int_equal(settings_mesh_digest(&digest, "/dev/zero", &err), FM_INVALID);
    assert_string_equal(err.message, "/dev/zero: is a device, not a file");
    assert_int_equal(settings_mesh_digest(&digest, "/", &err), FM_INVALID);
    assert_int_equal(settings_mesh_digest(&digest, "/nowhere/a.obj", &err), FM_IO);
}

static void scene_hash_reads_the_mesh_not_its_name(void **state)
{
    (void)state;
    char a[17], b[17], folder[] = "/tmp/fragmark-settings-XXXXXX", path[96];
    fm_error err;
    fm_settings settings = defaults();
    assert_non_null(mkdtemp(folder));
    set(&settings, "generator", "mesh");
    for (int i = 0; i < 2; i++) {
        snprintf(path, sizeof path, "%s/%d.obj", folder, i);
        assert_int_equal(text_write_file(path, "v 0 0 0\n", 8, &err), FM_OK);
        set(&settings, "mesh", path);
        settings_scene_hash(i == 0 ? a : b, &settings);
    }
    assert_string_equal(a, b);
    assert_int_equal(text_write_file(path, "v 0 0 1\n", 8, &err), FM_OK);
    settings_scene_hash(b, &settings);
    assert_string_not_equal(a, b);
    for (int i = 0; i < 2; i++) {
        snprintf(path, sizeof path, "%s/%d.obj", folder, i);
        unlink(path);
    }
    rmdir(folder);
}

/* Writes text as a scene file, reads it, and removes it. */
static fm_status read_scene(fm_settings *settings, const char *text, fm_error *err)
{
    char folder[] = "/tmp/fragmark-settings-XXXXXX", path[96];
    fm_error own;
    assert_non_null(mkdtemp(folder));
    snprintf(path, sizeof path, "%s/s.yml", folder);
    assert_int_equal(text_write_file(path, text, strlen(text), &own), FM_OK);
    const fm_status status = scene_file_read(settings, path, err);
    unlink(path);
    rmdir(folder);
    return status;
}

static void scene_file_read_sets_keys_over_defaults(void **state)
{
    (void)state;
    fm_error err = { 0 };
    fm_settings settings = { 0 };
    const char *text = "title: t\nmesh: m.obj\ngenerator: mesh\neye: [0, 1.5, 2]\nseed: 7\n";
    assert_int_equal(read_scene(&settings, text, &err), FM_OK);
    assert_int_equal(settings.generator, FM_GENERATOR_MESH);
    assert_int_equal(settings.width_px, 854);
    assert_true(settings.eye[1] > 1.4 && settings.eye[1] < 1.6);
    assert_int_equal(settings.seed, 7);
    assert_memory_equal(settings.mesh, "/tmp/fragmark-settings-", 23);
    assert_non_null(strstr(settings.mesh, "/m.obj"));
}

static void scene_file_read_refuses_with_line_and_nearest(void **state)
{
    (void)state;
    static const struct {
        const char *text, *message;
    } bad[] = {
        { "generator: layers\ntesselation: 4\n", "s.yml:2: no key 'tesselation'; the nearest is "
                                                 "'tessellation'" },
        { "licens: x\n", "the nearest is 'licence'" },
        { "k: 8\n", "s.yml:1: 'k' is no key of a scene" },
        { "zoom: 2\n", "s.yml:1: 'zoom' is not read by generator layers" },
        { "n: 8\nr: 2\n", "s.yml:2: n and r" },
        { "seed: -1\n", "s.yml:1: seed: '-1'" },
        { "seed: [1, 2]\n", "s.yml:1: seed: not one value" },
        { "- a\n", "s.yml:1: not 'key: value'" },
        { "seed: 1\nseed: 2\n", "s.yml:2: 'seed' stands on line 1" },
        { "title: [a]\n", "s.yml:1: title: not a text" },
    };
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        fm_error err = { 0 };
        fm_settings settings = { .k = 77 };
        assert_int_equal(read_scene(&settings, bad[i].text, &err), FM_INVALID);
        assert_int_equal(settings.k, 77);
        if (strstr(err.message, bad[i].message) == NULL)
            fail_msg("'%s' lacks '%s'", err.message, bad[i].message);
    }
}

static void scene_files_of_the_project_are_legal(void **state)
{
    (void)state;
    fm_error err = { 0 };
    fm_scene_names names = { 0 };
    assert_int_equal(scene_names_list(&names, &err), FM_OK);
    assert_true(names.count >= 2);
    for (size_t i = 0; i < names.count; i++) {
        fm_settings settings = { 0 };
        if (scene_file_read(&settings, names.paths[i], &err) != FM_OK ||
            settings_finish(&settings, &err) != FM_OK)
            fail_msg("%s", err.message);
    }
    scene_names_free(&names);
}

static void keys_of_enums_have_a_distinct_name_for_each_value(void **state)
{
    (void)state;
    for (size_t i = 0; i < fm_key_count; i++) {
        const fm_key *key = &fm_keys[i];
        assert_int_equal(key->type == FM_KEY_ENUM, key->value_count > 0);
        for (size_t v = 0; v < key->value_count; v++) {
            assert_non_null(key->values[v]);
            for (size_t w = 0; w < v; w++)
                assert_string_not_equal(key->values[v], key->values[w]);
        }
    }
}

static void feeds_have_names(void **state)
{
    (void)state;
    assert_int_equal(feed_from_name("compute-adjacent"), FM_FEED_COMPUTE_ADJACENT);
    assert_int_equal(feed_from_name("rastr"), 0);
    for (uint32_t feed = 1; (feed & FM_FEEDS_ALL) != 0; feed <<= 1)
        assert_int_equal(feed_from_name(feed_name(feed)), feed);
}

static void settings_for_truth_keep_the_scene_and_no_key_of_a_case(void **state)
{
    (void)state;
    char before[17], after[17];
    fm_settings settings = defaults(), truth;
    set(&settings, "r", "3");
    set(&settings, "k", "5");
    set(&settings, "pool", "per-frame");
    set(&settings, "culling", "occupancy");
    assert_int_equal(settings_finish(&settings, NULL), FM_OK);
    settings_for_truth(&truth, &settings);
    assert_int_equal(settings_finish(&truth, NULL), FM_OK);
    settings_scene_hash(before, &settings);
    settings_scene_hash(after, &truth);
    assert_string_equal(before, after);
    assert_int_equal(truth.n, 15);
    for (size_t i = 0; i < fm_key_count; i++) {
        char value[FM_PATH_MAX_BYTES];
        if (fm_keys[i].scope != FM_SCOPE_CASE)
            continue;
        settings_text(value, &truth, &fm_keys[i]);
        assert_string_equal(value, fm_keys[i].fallback);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(feeds_have_names),
        cmocka_unit_test(keys_of_enums_have_a_distinct_name_for_each_value),
        cmocka_unit_test(settings_defaults_are_the_synthetic_scene),
        cmocka_unit_test(keys_have_defaults_that_are_legal),
        cmocka_unit_test(percent_is_written_with_its_sign),
        cmocka_unit_test(key_nearest_corrects_spelling),
        cmocka_unit_test(keys_help_names_every_key),
        cmocka_unit_test(settings_set_refuses_and_says_what_is_legal),
        cmocka_unit_test(settings_text_is_taken_back_by_set),
        cmocka_unit_test(settings_finish_accepts_finished_settings),
        cmocka_unit_test(settings_finish_takes_no_layers_when_told),
        cmocka_unit_test(settings_finish_refuses_n_against_r),
        cmocka_unit_test(settings_finish_needs_a_k_for_r),
        cmocka_unit_test(settings_finish_bounds_layers_and_fragments),
        cmocka_unit_test(settings_finish_judges_meshes),
        cmocka_unit_test(scene_hash_mixes_only_what_the_generator_reads),
        cmocka_unit_test(scene_hash_has_quiet_keys_only_where_they_are_set),
        cmocka_unit_test(scene_hash_changes_with_the_generators_version),
        cmocka_unit_test(only_regular_files_are_digested),
        cmocka_unit_test(scene_hash_reads_the_mesh_not_its_name),
        cmocka_unit_test(scene_file_read_sets_keys_over_defaults),
        cmocka_unit_test(scene_file_read_refuses_with_line_and_nearest),
        cmocka_unit_test(scene_files_of_the_project_are_legal),
        cmocka_unit_test(settings_for_truth_keep_the_scene_and_no_key_of_a_case),
    };
    return cmocka_run_group_tests_name("settings", tests, NULL, NULL);
}
