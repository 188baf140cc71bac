/* A descriptor as bytes: what comes back is what was written, and damaged bytes are refused. So are
 * plugins without an answer, but not for a process that failed. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/random.h"
#include "describe/describe.h"
#include "describe/description.h"
#include "describe/fields.h"
#include "plugin/plugin.h"

enum { BUILT_IN_MIN = 40, MUTATIONS = 300, ALIGNMENT = 8 };

/* The fields of a struct lie side by side: a field without a row would leave a gap. */
static void assert_covered(const fm_layout *layout)
{
    size_t end = 0;
    for (size_t i = 0; i < layout->count; i++) {
        const fm_field *field = &layout->fields[i];
        if (field->offset_bytes < end || field->offset_bytes >= end + ALIGNMENT)
            fail_msg("%s.%s: at %zu, the fields before end at %zu", layout->name, field->name,
                     field->offset_bytes, end);
        end = field->offset_bytes + field->count * field->unit_bytes;
        if (field->inside != NULL)
            assert_covered(field->inside);
        if (field->kind == FM_FIELD_STRUCT)
            assert_int_equal(field->unit_bytes, field->inside->size_bytes);
    }
    assert_true(layout->size_bytes < end + ALIGNMENT);
}

static void the_table_has_every_field(void **state)
{
    (void)state;
    assert_covered(&method_layout);
    assert_int_equal(method_layout.size_bytes, sizeof(fm_method_desc));
}

static void assert_equal(const void *left, const void *right, const fm_layout *layout);

static void assert_item_equal(const char *left, const char *right, const fm_field *field)
{
    const void *a, *b;
    if (field->kind == FM_FIELD_STRUCT) {
        assert_equal(left, right, field->inside);
        return;
    }
    if (field->kind == FM_FIELD_NUMBER || field->kind == FM_FIELD_BOOL) {
        assert_memory_equal(left, right, field->unit_bytes);
        return;
    }
    memcpy(&a, left, sizeof a);
    memcpy(&b, right, sizeof b);
    if ((a == NULL) != (b == NULL))
        fail_msg("%s: one has it, the other has not", field->name);
    if (a != NULL && field->kind == FM_FIELD_TEXT)
        assert_string_equal(a, b);
    if (a != NULL && field->kind == FM_FIELD_POINTER)
        assert_equal(a, b, field->inside);
}

static void assert_equal(const void *left, const void *right, const fm_layout *layout)
{
    for (size_t i = 0; i < layout->count; i++) {
        const fm_field *field = &layout->fields[i];
        for (size_t j = 0; j < field->count; j++) {
            const size_t offset = field->offset_bytes + j * field->unit_bytes;
            assert_item_equal((const char *)left + offset, (const char *)right + offset, field);
        }
    }
}

static fm_text written(const fm_method_desc *method)
{
    fm_text bytes = { 0 };
    fm_error err = { 0 };
    if (description_write(&bytes, method, &err) != FM_OK)
        fail_msg("%s: %s", method->id, err.message);
    return bytes;
}

/* The methods that come with fragmark, loaded. */
static fm_plugin_list built_in(void)
{
    fm_plugin_list list;
    fm_error err = { 0 };
    if (plugin_list_open(&list, NULL, &err) != FM_OK || plugin_list_read_all(&list, &err) != FM_OK)
        fail_msg("%s", err.message);
    assert_true(list.count >= BUILT_IN_MIN);
    return list;
}

static void every_built_in_method_comes_back_as_it_was(void **state)
{
    (void)state;
    size_t techniques = 0;
    fm_plugin_list list = built_in();
    for (size_t i = 0; i < list.count; i++) {
        const fm_method_desc *method = list.entries[i].plugin->method, *back;
        void *memory;
        fm_error err = { 0 };
        fm_text bytes = written(method);
        if (description_read(&back, &memory, (const uint8_t *)bytes.bytes, bytes.length, "x.so",
                             &err) != FM_OK)
            fail_msg("%s: %s", method->id, err.message);
        assert_equal(method, back, &method_layout);
        techniques += back->technique != NULL;
        free(memory);
        text_free(&bytes);
    }
    assert_true(techniques > 0);
    plugin_list_close(&list);
}

/* Whether it is taken; a refusal has a reason and leaves nothing behind. */
static bool is_taken(const uint8_t *bytes, size_t count)
{
    const fm_method_desc *method;
    void *memory;
    fm_error err = { 0 };
    uint8_t *exact = malloc(count > 0 ? count : 1); /* so that a sanitizer sees its end */
    assert_non_null(exact);
    memcpy(exact, bytes, count);
    const fm_status status = description_read(&method, &memory, exact, count, "x.so", &err);
    free(exact);
    if (status == FM_OK) {
        assert_int_equal(plugin_check(method, "x.so", &err), FM_OK);
        free(memory);
        return true;
    }
    assert_int_equal(status, FM_INVALID);
    assert_int_equal(strncmp(err.message, "x.so: ", 6), 0);
    assert_null(method);
    assert_null(memory);
    return false;
}

static void a_cut_or_longer_description_is_refused(void **state)
{
    (void)state;
    fm_plugin_list list = built_in();
    fm_text bytes = written(list.entries[0].plugin->method);
    for (size_t count = 0; count < bytes.length; count += 1 + count / 40)
        assert_false(is_taken((const uint8_t *)bytes.bytes, count));
    assert_true(is_taken((const uint8_t *)bytes.bytes, bytes.length));
    text_add_raw(&bytes, "", 1);
    assert_false(is_taken((const uint8_t *)bytes.bytes, bytes.length));
    text_free(&bytes);
    plugin_list_close(&list);
}

/* A few bytes become other ones. */
static void mutate(uint8_t *bytes, size_t count, uint64_t *random)
{
    static const uint8_t likely[] = { 0, 1, 2, 0x7F, 0x80, 0xFF };
    for (uint32_t left = 1 + random_below(random, 4); left > 0; left--) {
        const uint32_t at = random_below(random, (uint32_t)count);
        bytes[at] = random_below(random, 2) == 0 ? likely[random_below(random, sizeof likely)]
                                                 : (uint8_t)random_next(random);
    }
}

static void damaged_descriptions_are_taken_whole_or_refused(void **state)
{
    (void)state;
    size_t taken = 0, refused = 0;
    uint64_t random = 1;
    fm_plugin_list list = built_in();
    for (size_t i = 0; i < list.count; i++) {
        fm_text bytes = written(list.entries[i].plugin->method);
        uint8_t *copy = malloc(bytes.length);
        assert_non_null(copy);
        for (int j = 0; j < MUTATIONS; j++) {
            memcpy(copy, bytes.bytes, bytes.length);
            mutate(copy, bytes.length, &random);
            if (is_taken(copy, bytes.length))
                taken++;
            else
                refused++;
        }
        free(copy);
        text_free(&bytes);
    }
    assert_true(taken > 0);
    assert_true(refused > taken / 4);
    plugin_list_close(&list);
}

static void a_text_without_an_end_is_not_written(void **state)
{
    (void)state;
    char *text = malloc(FM_DESCRIPTION_MAX_BYTES + 1);
    assert_non_null(text);
    memset(text, 'a', FM_DESCRIPTION_MAX_BYTES);
    text[FM_DESCRIPTION_MAX_BYTES] = '\0';
    const fm_method_desc method = { .id = "x", .title = text };
    fm_text bytes = { 0 };
    fm_error err = { 0 };
    assert_int_equal(description_write(&bytes, &method, &err), FM_INVALID);
    assert_non_null(strstr(err.message, "title: too long, or without an end"));
    text_free(&bytes);
    free(text);
}

/* What is said of a plugin when this program describes it. */
static fm_status describe_by(fm_plugin_entry *entry, const char *program, fm_error *err)
{
    const fm_describer describer = { .program = program, .cache = "" };
    const fm_plugin_list list = { .reader_context = &describer };
    *entry = (fm_plugin_entry){ .id = "a", .path = "/nowhere/a/a.so" };
    return describe_plugins(&list, &entry, 1, err);
}

static void plugin_is_not_refused_for_a_process_that_failed(void **state)
{
    (void)state;
    static const char script[] = "#!/bin/sh\necho no room >&2\nkill -KILL $$\n";
    char program[] = "/tmp/fragmark-describe-XXXXXX";
    fm_plugin_entry entry;
    fm_error err = { 0 };
    assert_int_equal(describe_by(&entry, "/bin/false", &err), FM_IO);
    assert_non_null(strstr(err.message, "exited with status 1"));
    assert_false(plugin_entry_is_refused(&entry));
    const int file = mkstemp(program);
    assert_int_equal(write(file, script, sizeof script - 1), sizeof script - 1);
    assert_int_equal(fchmod(file, 0700), 0);
    close(file);
    assert_int_equal(describe_by(&entry, program, &err), FM_IO);
    assert_non_null(strstr(err.message, "was killed by SIGKILL: no room"));
    assert_int_equal(describe_by(&entry, "/bin/true", &err), FM_OK);
    assert_true(plugin_entry_is_refused(&entry));
    unlink(program);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_table_has_every_field),
        cmocka_unit_test(every_built_in_method_comes_back_as_it_was),
        cmocka_unit_test(a_cut_or_longer_description_is_refused),
        cmocka_unit_test(damaged_descriptions_are_taken_whole_or_refused),
        cmocka_unit_test(a_text_without_an_end_is_not_written),
        cmocka_unit_test(plugin_is_not_refused_for_a_process_that_failed),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
