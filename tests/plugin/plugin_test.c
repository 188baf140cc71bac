/* Plugins: opening, refusing with a message that helps, listing. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "plugin/plugin.h"

/* Opens the test plugin FM_TEST_PLUGINS/id/id.so, which must be refused with that part in the
 * message. */
static void assert_plugin_refused(const char *id, const char *part)
{
    char path[FM_PATH_MAX_BYTES];
    fm_plugin *plugin;
    fm_error err = { 0 };
    snprintf(path, sizeof path, "%s/%s/%s.so", FM_TEST_PLUGINS, id, id);
    assert_int_equal(plugin_open(&plugin, path, NULL, &err), FM_INVALID);
    assert_null(plugin);
    snprintf(path, sizeof path, "%s.so: ", id);
    if (strncmp(err.message, path, strlen(path)) != 0 || strstr(err.message, part) == NULL)
        fail_msg("'%s' is not in: %s", part, err.message);
}

/* Finds plugins, and loads all of them. */
static void open_list(fm_plugin_list *list, const char *const *folders)
{
    fm_error err = { 0 };
    if (plugin_list_open(list, folders, &err) != FM_OK || plugin_list_read_all(list, &err) != FM_OK)
        fail_msg("%s", err.message);
}

static void plugin_open_takes_a_good_plugin(void **state)
{
    (void)state;
    fm_plugin *plugin;
    fm_error err = { 0 };
    if (plugin_open(&plugin, FM_TEST_PLUGINS "/good/good.so", NULL, &err) != FM_OK)
        fail_msg("%s", err.message);
    assert_string_equal(plugin->method->id, "good");
    assert_string_equal(plugin->folder, FM_TEST_PLUGINS "/good");
    plugin_close(plugin);
    plugin_close(NULL);
}

static void plugin_open_rejects_wrong_abi(void **state)
{
    (void)state;
    assert_plugin_refused("wrong-abi", "abi: the plugin has");
}

static void plugin_open_rejects_wrong_size(void **state)
{
    (void)state;
    assert_plugin_refused("wrong-size", "size_bytes: the plugin has 64");
}

static void plugin_open_rejects_a_missing_symbol(void **state)
{
    (void)state;
    assert_plugin_refused("no-symbol", "no symbol 'fm_method'");
}

static void plugin_open_rejects_a_zero_sized_buffer(void **state)
{
    (void)state;
    assert_plugin_refused("zero-buffer", "resource 'nearest': extent: all terms are zero");
}

static void plugin_open_rejects_an_unknown_kind(void **state)
{
    (void)state;
    assert_plugin_refused("unknown-kind", "pass 'extra': kind: 8: no such value");
}

static void plugin_open_names_the_nearest_resource(void **state)
{
    (void)state;
    assert_plugin_refused("unknown-resource", "pass 'resolve': reads 'neerest': no such resource; "
                                              "nearest is 'nearest'");
}

static void plugin_open_names_the_nearest_pass(void **state)
{
    (void)state;
    assert_plugin_refused("unknown-pass",
                          "loop 'stor': first 'stor': no such pass; nearest is 'store'");
}

static void plugin_open_rejects_a_missing_shader(void **state)
{
    (void)state;
    assert_plugin_refused("missing-shader", "pass 'resolve': shader 'nowhere.glsl': cannot read");
}

static void plugin_open_rejects_another_file_name(void **state)
{
    (void)state;
    assert_plugin_refused("wrong-name", "id: 'another-name': the file must be named");
}

static void plugin_open_takes_a_shader_that_will_not_compile(void **state)
{
    (void)state;
    fm_plugin *plugin;
    assert_int_equal(
        plugin_open(&plugin, FM_TEST_PLUGINS "/broken-shader/broken-shader.so", NULL, NULL), FM_OK);
    plugin_close(plugin);
}

static void plugin_open_of_a_missing_file_is_an_io_error(void **state)
{
    (void)state;
    fm_plugin *plugin;
    fm_error err;
    assert_int_equal(plugin_open(&plugin, "/nonexistent/x.so", NULL, &err), FM_IO);
    assert_null(plugin);
}

static void plugin_open_rejects_what_is_no_shared_object(void **state)
{
    (void)state;
    fm_plugin *plugin;
    fm_error err;
    assert_int_equal(plugin_open(&plugin, FM_TEST_PLUGINS "/good/store.glsl", NULL, &err),
                     FM_INVALID);
    assert_non_null(strstr(err.message, "cannot be loaded"));
}

static void plugin_list_holds_good_and_refused_plugins(void **state)
{
    (void)state;
    const char *const folders[] = { FM_TEST_PLUGINS, NULL };
    fm_plugin_list list;
    unsetenv("FRAGMARK_PLUGIN_PATH");
    open_list(&list, folders);
    assert_int_equal(list.count, 12);
    for (size_t i = 1; i < list.count; i++)
        assert_true(strcmp(list.entries[i - 1].id, list.entries[i].id) < 0);
    const fm_plugin_entry *good = plugin_list_find(&list, "good");
    assert_non_null(good);
    assert_non_null(good->plugin);
    const fm_plugin_entry *refused = plugin_list_find(&list, "wrong-abi");
    assert_non_null(refused);
    assert_null(refused->plugin);
    assert_int_equal(refused->error.status, FM_INVALID);
    plugin_list_close(&list);
}

static void plugin_list_takes_the_first_folder_of_an_id(void **state)
{
    (void)state;
    const char *const folders[] = { FM_TEST_PLUGINS, NULL };
    fm_plugin_list list;
    setenv("FRAGMARK_PLUGIN_PATH", ":" FM_TEST_PLUGINS "/.::", 1);
    open_list(&list, folders);
    assert_int_equal(list.count, 12);
    assert_string_equal(plugin_list_find(&list, "good")->plugin->folder, FM_TEST_PLUGINS "/good");
    plugin_list_close(&list);
}

static void plugin_list_get_names_the_nearest_id(void **state)
{
    (void)state;
    const char *const folders[] = { FM_TEST_PLUGINS, NULL };
    fm_plugin_list list;
    fm_plugin_entry *entry;
    fm_error err;
    unsetenv("FRAGMARK_PLUGIN_PATH");
    open_list(&list, folders);
    assert_int_equal(plugin_list_get(&entry, &list, "good", &err), FM_OK);
    assert_int_equal(plugin_list_get(&entry, &list, "goood", &err), FM_INVALID);
    assert_non_null(strstr(err.message, "nearest is 'good'"));
    assert_int_equal(plugin_list_get(&entry, &list, "entirely-different", &err), FM_INVALID);
    plugin_list_close(&list);
}

static void plugin_list_without_a_floor_says_so(void **state)
{
    (void)state;
    const char *const folders[] = { FM_TEST_PLUGINS, NULL };
    fm_plugin_list list;
    const fm_plugin *floor;
    fm_error err;
    unsetenv("FRAGMARK_PLUGIN_PATH");
    open_list(&list, folders);
    assert_int_equal(plugin_list_floor(&floor, &list, FM_FEED_RASTER, &err), FM_INVALID);
    assert_null(floor);
    plugin_list_close(&list);
}

static void plugin_list_names_a_folder_that_is_missing(void **state)
{
    (void)state;
    const char *const folders[] = { "/nonexistent/plugins", NULL };
    fm_plugin_list list;
    fm_error err;
    unsetenv("FRAGMARK_PLUGIN_PATH");
    assert_int_equal(plugin_list_open(&list, folders, &err), FM_IO);
    assert_non_null(strstr(err.message, "/nonexistent/plugins"));
    assert_int_equal(list.count, 0);
    setenv("FRAGMARK_PLUGIN_PATH", "/nonexistent/other", 1);
    assert_int_equal(plugin_list_open(&list, NULL, &err), FM_IO);
    assert_non_null(strstr(err.message, "FRAGMARK_PLUGIN_PATH"));
}

/* A folder of methods with the runner's GLSL, and a method `lender` that has one shader. */
static void make_lender(char root[32])
{
    char command[256];
    assert_non_null(mkdtemp(root));
    snprintf(command, sizeof command,
             "mkdir %s/common %s/lender && touch %s/common/prelude.glsl %s/lender/piece.glsl", root,
             root, root, root);
    assert_int_equal(system(command), 0);
}

static void a_shader_of_another_method_lies_beside_the_runners_too(void **state)
{
    (void)state;
    char root[32] = "/tmp/fragmark-plugins-XXXXXX", command[64];
    fm_plugin_list list;
    make_lender(root);
    const char *const folders[] = { FM_TEST_PLUGINS, root, NULL };
    unsetenv("FRAGMARK_PLUGIN_PATH");
    open_list(&list, folders);
    assert_non_null(plugin_list_find(&list, "borrower")->plugin);
    plugin_list_close(&list);
    snprintf(command, sizeof command, "rm -r %s", root);
    assert_int_equal(system(command), 0);
}

static void a_shader_of_another_method_that_is_nowhere_is_refused(void **state)
{
    (void)state;
    assert_plugin_refused("borrower", "pass 'resolve': shader 'lender/piece.glsl': cannot read");
}

static void plugin_list_finds_the_runners_shaders(void **state)
{
    (void)state;
    char root[] = "/tmp/fragmark-plugins-XXXXXX", path[64], command[256];
    fm_plugin_list list;
    assert_non_null(mkdtemp(root));
    snprintf(path, sizeof path, "%s/common", root);
    snprintf(command, sizeof command, "mkdir %s && touch %s/prelude.glsl", path, path);
    assert_int_equal(system(command), 0);
    const char *const folders[] = { FM_TEST_PLUGINS, root, NULL };
    unsetenv("FRAGMARK_PLUGIN_PATH");
    open_list(&list, folders);
    assert_string_equal(list.common_folder, path);
    plugin_list_close(&list);
    snprintf(command, sizeof command, "rm -r %s", root);
    assert_int_equal(system(command), 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(plugin_open_takes_a_good_plugin),
        cmocka_unit_test(plugin_open_rejects_wrong_abi),
        cmocka_unit_test(plugin_open_rejects_wrong_size),
        cmocka_unit_test(plugin_open_rejects_a_missing_symbol),
        cmocka_unit_test(plugin_open_rejects_a_zero_sized_buffer),
        cmocka_unit_test(plugin_open_rejects_an_unknown_kind),
        cmocka_unit_test(plugin_open_names_the_nearest_resource),
        cmocka_unit_test(plugin_open_names_the_nearest_pass),
        cmocka_unit_test(plugin_open_rejects_a_missing_shader),
        cmocka_unit_test(plugin_open_rejects_another_file_name),
        cmocka_unit_test(plugin_open_takes_a_shader_that_will_not_compile),
        cmocka_unit_test(plugin_open_of_a_missing_file_is_an_io_error),
        cmocka_unit_test(plugin_open_rejects_what_is_no_shared_object),
        cmocka_unit_test(plugin_list_holds_good_and_refused_plugins),
        cmocka_unit_test(plugin_list_takes_the_first_folder_of_an_id),
        cmocka_unit_test(plugin_list_get_names_the_nearest_id),
        cmocka_unit_test(plugin_list_without_a_floor_says_so),
        cmocka_unit_test(plugin_list_names_a_folder_that_is_missing),
        cmocka_unit_test(a_shader_of_another_method_lies_beside_the_runners_too),
        cmocka_unit_test(a_shader_of_another_method_that_is_nowhere_is_refused),
        cmocka_unit_test(plugin_list_finds_the_runners_shaders),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
