#include "description.h"

#include <stdlib.h>
#include <string.h>

#include "code/code.h"
#include "fields.h"
#include "fragmark/technique.h"
#include "plugin/plugin.h"

/* In front of what follows from the table of fields: numbers and bools as they lie in memory, a
 * text as its length with the NUL (0: none) and its bytes, a hook or a pointer as 1 or 0. */
static const char magic[] = "fragmark descriptor";

/* A descriptor that was read, with all that it points to. */
typedef struct described {
    fm_method_desc method;
    fm_technique technique;
    uint8_t bytes[]; /* a copy of the description: texts lie in it */
} described;

/* What is written, or why it cannot be. */
typedef struct writer {
    fm_text *out;
    fm_error *err;
} writer;

static fm_status write_struct(writer *to, const void *from, const fm_layout *layout);

static void add_byte(writer *to, bool is_set)
{
    const char byte = is_set ? 1 : 0;
    text_add_raw(to->out, &byte, 1);
}

static fm_status write_text(writer *to, const char *text, const fm_field *field)
{
    uint32_t length = 0;
    if (text != NULL) {
        const size_t used = to->out->length, all = FM_DESCRIPTION_MAX_BYTES;
        const size_t room = used < all ? all - used : 0;
        const size_t found = strnlen(text, room);
        if (found == room)
            return fm_fail(to->err, FM_INVALID, "%s: too long, or without an end", field->name);
        length = (uint32_t)found + 1;
    }
    text_add_raw(to->out, (const char *)&length, sizeof length);
    text_add_raw(to->out, text != NULL ? text : "", length);
    return FM_OK;
}

/* The pointer that lies at an address, whatever it points to. */
static const void *pointer_at(const char *at)
{
    const void *pointer;
    memcpy(&pointer, at, sizeof pointer);
    return pointer;
}

static bool hook_is_at(const char *at)
{
    void (*hook)(void);
    memcpy(&hook, at, sizeof hook);
    return hook != NULL;
}

static fm_status write_item(writer *to, const char *at, const fm_field *field)
{
    switch (field->kind) {
    case FM_FIELD_NUMBER:
    case FM_FIELD_BOOL:
        text_add_raw(to->out, at, field->unit_bytes);
        return FM_OK;
    case FM_FIELD_TEXT:
        return write_text(to, pointer_at(at), field);
    case FM_FIELD_HOOK:
        add_byte(to, hook_is_at(at));
        return FM_OK;
    case FM_FIELD_STRUCT:
        return write_struct(to, at, field->inside);
    case FM_FIELD_POINTER:
        break;
    }
    add_byte(to, pointer_at(at) != NULL);
    return pointer_at(at) != NULL ? write_struct(to, pointer_at(at), field->inside) : FM_OK;
}

static fm_status write_struct(writer *to, const void *from, const fm_layout *layout)
{
    fm_status status = FM_OK;
    for (size_t i = 0; i < layout->count; i++) {
        const fm_field *field = &layout->fields[i];
        const char *at = (const char *)from + field->offset_bytes;
        for (size_t j = 0; j < field->count && status == FM_OK; j++)
            status = write_item(to, at + j * field->unit_bytes, field);
    }
    return status;
}

fm_status description_write(fm_text *bytes, const fm_method_desc *method, fm_error *err)
{
    writer to = { bytes, err };
    text_add_raw(bytes, magic, sizeof magic);
    const fm_status status = write_struct(&to, method, &method_layout);
    if (status == FM_OK && bytes->failed)
        return fm_fail(err, FM_NO_MEMORY, "no memory for a description");
    if (status == FM_OK && bytes->length > FM_DESCRIPTION_MAX_BYTES)
        return fm_fail(err, FM_INVALID, "a descriptor of %zu bytes, %d at most", bytes->length,
                       FM_DESCRIPTION_MAX_BYTES);
    return status;
}

/* All that write_struct and read_struct look at. */
static uint64_t hash_layout(uint64_t hash, const fm_layout *layout)
{
    for (size_t i = 0; i < layout->count; i++) {
        const fm_field *field = &layout->fields[i];
        const uint64_t facts[] = { hash, (uint64_t)field->kind, field->unit_bytes, field->count,
                                   code_hash(field->name, strlen(field->name)) };
        hash = code_hash(facts, sizeof facts);
        if (field->inside != NULL)
            hash = hash_layout(hash, field->inside);
    }
    return hash;
}

uint64_t description_form(void)
{
    const uint64_t facts[] = { FM_ABI, FM_DESCRIPTION_MAX_BYTES };
    return hash_layout(code_hash(facts, sizeof facts), &method_layout);
}

/* What is still to be read, and where the one technique goes. */
typedef struct reader {
    const uint8_t *at;
    size_t left;
    fm_technique *technique;
    fm_error *err;
} reader;

static fm_status read_struct(reader *from, void *to, const fm_layout *layout);

/* The next bytes; NULL: there are not so many. */
static const uint8_t *take(reader *from, size_t count)
{
    const uint8_t *taken = from->at;
    if (count > from->left)
        return NULL;
    from->at += count;
    from->left -= count;
    return taken;
}

static fm_status damaged(reader *from, const fm_field *field, const char *what)
{
    return fm_fail(from->err, FM_INVALID, "its description is damaged: %s: %s", field->name, what);
}

static fm_status read_bool(bool *is_set, reader *from, const fm_field *field)
{
    const uint8_t *byte = take(from, 1);
    if (byte == NULL)
        return damaged(from, field, "cut off");
    if (*byte > 1)
        return damaged(from, field, "neither true nor false");
    *is_set = *byte == 1;
    return FM_OK;
}

static fm_status read_text(const char **text, reader *from, const fm_field *field)
{
    uint32_t length;
    const uint8_t *bytes = take(from, sizeof length);
    *text = NULL;
    if (bytes == NULL)
        return damaged(from, field, "cut off");
    memcpy(&length, bytes, sizeof length);
    if (length == 0)
        return FM_OK;
    bytes = take(from, length);
    if (bytes == NULL || memchr(bytes, '\0', length) != bytes + length - 1)
        return damaged(from, field, "a text without an end");
    *text = (const char *)bytes;
    return FM_OK;
}

static void never_called(void)
{
    abort();
}

static fm_status read_hook(char *to, reader *from, const fm_field *field)
{
    void (*const hook)(void) = never_called;
    bool is_set;
    const fm_status status = read_bool(&is_set, from, field);
    if (status == FM_OK && is_set)
        memcpy(to, &hook, sizeof hook);
    return status;
}

static fm_status read_technique(char *to, reader *from, const fm_field *field)
{
    bool is_set;
    const fm_status status = read_bool(&is_set, from, field);
    if (status != FM_OK || !is_set)
        return status;
    memcpy(to, &from->technique, sizeof from->technique);
    return read_struct(from, from->technique, field->inside);
}

static fm_status read_item(reader *from, char *to, const fm_field *field)
{
    const uint8_t *number;
    const char *text;
    bool is_set;
    fm_status status = FM_OK;
    switch (field->kind) {
    case FM_FIELD_NUMBER:
        number = take(from, field->unit_bytes);
        if (number == NULL)
            return damaged(from, field, "cut off");
        memcpy(to, number, field->unit_bytes);
        return FM_OK;
    case FM_FIELD_BOOL:
        status = read_bool(&is_set, from, field);
        if (status == FM_OK)
            memcpy(to, &is_set, sizeof is_set);
        return status;
    case FM_FIELD_TEXT:
        status = read_text(&text, from, field);
        if (status == FM_OK)
            memcpy(to, &text, sizeof text);
        return status;
    case FM_FIELD_HOOK:
        return read_hook(to, from, field);
    case FM_FIELD_STRUCT:
        return read_struct(from, to, field->inside);
    case FM_FIELD_POINTER:
        break;
    }
    return read_technique(to, from, field);
}

static fm_status read_struct(reader *from, void *to, const fm_layout *layout)
{
    fm_status status = FM_OK;
    for (size_t i = 0; i < layout->count; i++) {
        const fm_field *field = &layout->fields[i];
        char *at = (char *)to + field->offset_bytes;
        for (size_t j = 0; j < field->count && status == FM_OK; j++)
            status = read_item(from, at + j * field->unit_bytes, field);
    }
    return status;
}

static fm_status read_all(described *made, size_t count, fm_error *err)
{
    reader from = { .at = made->bytes, .left = count, .technique = &made->technique, .err = err };
    const uint8_t *head = take(&from, sizeof magic);
    if (head == NULL || memcmp(head, magic, sizeof magic) != 0)
        return fm_fail(err, FM_INVALID, "what describes it is no description");
    const fm_status status = read_struct(&from, &made->method, &method_layout);
    if (status == FM_OK && from.left > 0)
        return fm_fail(err, FM_INVALID, "its description is damaged: %zu bytes too long",
                       from.left);
    return status;
}

fm_status description_read(const fm_method_desc **method, void **memory, const uint8_t *bytes,
                           size_t count, const char *name, fm_error *err)
{
    described *made = NULL;
    *method = NULL;
    *memory = NULL;
    if (count > FM_DESCRIPTION_MAX_BYTES)
        return fm_fail(err, FM_INVALID, "%s: a description of %zu bytes, %d at most", name, count,
                       FM_DESCRIPTION_MAX_BYTES);
    made = calloc(1, sizeof *made + count);
    if (made == NULL)
        return fm_fail(err, FM_NO_MEMORY, "%s: no memory for its description", name);
    memcpy(made->bytes, bytes, count);
    fm_status status = read_all(made, count, err);
    if (status != FM_OK)
        status = fm_error_prefix(err, "%s", name);
    else
        status = plugin_check(&made->method, name, err);
    if (status != FM_OK) {
        free(made);
        return status;
    }
    *method = &made->method;
    *memory = made;
    return FM_OK;
}
