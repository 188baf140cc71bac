#include "text.h"

#include <ctype.h>
#include <errno.h>
#include <float.h>
#include <locale.h>
#include <math.h>
#include <search.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "file.h"

enum { WORD_MAX = 127 }; /* longest word that text_nearest compares */

/* Room for `more` bytes and a NUL. */
static bool text_reserve(fm_text *text, size_t more)
{
    if (text->failed || more >= SIZE_MAX / 2 - text->length)
        text->failed = true;
    if (text->failed || text->length + more < text->capacity)
        return !text->failed;
    size_t capacity = text->capacity > 0 ? text->capacity : 256;
    while (capacity <= text->length + more)
        capacity *= 2;
    char *bytes = realloc(text->bytes, capacity);
    text->failed = bytes == NULL;
    if (bytes == NULL)
        return false;
    text->bytes = bytes;
    text->capacity = capacity;
    return true;
}

void text_add(fm_text *text, const char *format, ...)
{
    va_list arguments, again;
    va_start(arguments, format);
    va_copy(again, arguments);
    const int length = vsnprintf(NULL, 0, format, arguments);
    if (length < 0)
        text->failed = true;
    else if (text_reserve(text, (size_t)length)) {
        vsnprintf(text->bytes + text->length, (size_t)length + 1, format, again);
        text->length += (size_t)length;
    }
    va_end(again);
    va_end(arguments);
}

void text_add_raw(fm_text *text, const char *bytes, size_t count)
{
    if (!text_reserve(text, count))
        return;
    if (count > 0)
        memcpy(text->bytes + text->length, bytes, count);
    text->length += count;
    text->bytes[text->length] = '\0';
}

void text_free(fm_text *text)
{
    free(text->bytes);
    *text = (fm_text){ 0 };
}

bool text_list_add(fm_text_list *list, const char *text)
{
    if (list->count + 1 >= list->capacity) { /* room for the NULL too */
        const size_t capacity = list->capacity > 0 ? 2 * list->capacity : 8;
        char **items = realloc(list->items, capacity * sizeof *items);
        if (items == NULL)
            return false;
        list->items = items;
        list->capacity = capacity;
    }
    char *copy = strdup(text);
    if (copy == NULL)
        return false;
    list->items[list->count++] = copy;
    list->items[list->count] = NULL;
    return true;
}

bool text_list_add_all(fm_text_list *list, const fm_text_list *from)
{
    for (size_t i = 0; from != NULL && i < from->count; i++)
        if (!text_list_add(list, from->items[i]))
            return false;
    return true;
}

bool text_list_has(const fm_text_list *list, const char *text)
{
    for (size_t i = 0; list != NULL && i < list->count; i++)
        if (strcmp(list->items[i], text) == 0)
            return true;
    return false;
}

const char *const *text_list_items(const fm_text_list *list)
{
    static const char *const none[] = { NULL };
    return list->items != NULL ? (const char *const *)list->items : none;
}

void text_list_free(fm_text_list *list)
{
    for (size_t i = 0; i < list->count; i++)
        free(list->items[i]);
    free(list->items);
    *list = (fm_text_list){ 0 };
}

static int compare_texts(const void *a, const void *b)
{
    return strcmp(a, b);
}

const char *text_shared(const char *text)
{
    static void *texts; /* a tree of tsearch(3) */
    if (*text == '\0')
        return "";
    const char *const *found = tfind(text, &texts, compare_texts);
    if (found != NULL)
        return *found;
    char *copy = strdup(text);
    if (copy == NULL || tsearch(copy, &texts, compare_texts) == NULL) {
        free(copy);
        return NULL;
    }
    return copy;
}

/* Reads to the end, so that /proc files, whose size is not known, work too. */
static fm_status read_stream(fm_text *text, FILE *file, const char *path, size_t limit_bytes,
                             fm_error *err)
{
    char block[65536];
    for (;;) {
        const size_t count = fread(block, 1, sizeof block, file);
        if (count > limit_bytes - text->length)
            return fm_fail(err, FM_INVALID, "%s: larger than %zu bytes", path, limit_bytes);
        text_add_raw(text, block, count);
        if (text->failed)
            return fm_fail(err, FM_NO_MEMORY, "%s: no memory to read it", path);
        if (count < sizeof block)
            break;
    }
    if (ferror(file))
        return fm_fail(err, FM_IO, "%s: %s", path, strerror(errno));
    return FM_OK;
}

fm_status text_read_file(char **bytes, size_t *count, const char *path, size_t limit_bytes,
                         fm_error *err)
{
    fm_text text = { 0 };
    *bytes = NULL;
    *count = 0;
    FILE *file = NULL;
    fm_status status = file_open_stream(&file, path, err);
    if (status != FM_OK)
        return status;
    status = read_stream(&text, file, path, limit_bytes, err);
    if (status == FM_OK) {
        *bytes = text.bytes;
        *count = text.length;
        text = (fm_text){ 0 };
    }
    text_free(&text);
    fclose(file);
    return status;
}

static bool write_all(int file, const char *bytes, size_t count)
{
    while (count > 0) {
        const ssize_t written = write(file, bytes, count);
        if (written < 0 && errno != EINTR)
            return false;
        if (written > 0) {
            bytes += written;
            count -= (size_t)written;
        }
    }
    return true;
}

fm_status text_write_file(const char *path, const char *bytes, size_t count, fm_error *err)
{
    int file = -1;
    fm_text partial = { 0 };
    text_add(&partial, "%s.partial", path);
    if (partial.failed)
        return fm_fail(err, FM_NO_MEMORY, "%s: no memory for its name", path);
    fm_status status = file_check_replaceable(path, err);
    if (status == FM_OK)
        status = file_create(&file, partial.bytes, err);
    if (status != FM_OK)
        goto out;
    int failure = write_all(file, bytes, count) && fsync(file) == 0 ? 0 : errno;
    if (close(file) != 0 && failure == 0)
        failure = errno;
    if (failure == 0 && rename(partial.bytes, path) != 0)
        failure = errno;
    if (failure != 0) {
        status = fm_fail(err, FM_IO, "%s: %s", path, strerror(failure));
        unlink(partial.bytes);
    }
out:
    text_free(&partial);
    return status;
}

static size_t least(size_t a, size_t b)
{
    return a < b ? a : b;
}

/* Levenshtein's distance, one row of the table at a time. */
static size_t edit_distance(const char *a, size_t a_length, const char *b, size_t b_length)
{
    size_t row[WORD_MAX + 1];
    for (size_t j = 0; j <= b_length; j++)
        row[j] = j;
    for (size_t i = 1; i <= a_length; i++) {
        size_t diagonal = row[0];
        row[0] = i;
        for (size_t j = 1; j <= b_length; j++) {
            const size_t above = row[j];
            const size_t replaced = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
            row[j] = least(replaced, least(above, row[j - 1]) + 1);
            diagonal = above;
        }
    }
    return row[b_length];
}

const char *text_nearest(const char *word, const char *const *names, size_t count)
{
    const char *nearest = NULL;
    const size_t length = strlen(word);
    size_t best = length / 2 + 1;
    if (length > WORD_MAX)
        return NULL;
    for (size_t i = 0; i < count; i++) {
        const size_t name_length = strlen(names[i]);
        if (name_length > WORD_MAX)
            continue;
        const size_t distance = edit_distance(word, length, names[i], name_length);
        if (distance < best) {
            best = distance;
            nearest = names[i];
        }
    }
    return nearest;
}

/* Bytes of the character that text starts with; 0: none of UTF-8. */
static size_t utf8_bytes(const char *text)
{
    static const uint32_t least[] = { 0, 0, 0x80, 0x800, 0x10000 }; /* by bytes: else overlong */
    const unsigned char lead = (unsigned char)*text;
    const size_t count = lead < 0x80 ? 1 : lead < 0xC0 ? 0 : lead < 0xE0 ? 2 : lead < 0xF0 ? 3 : 4;
    uint32_t code = count < 2 ? lead : lead & (0xFFu >> (count + 1));
    for (size_t i = 1; i < count; i++) {
        const unsigned char next = (unsigned char)text[i];
        if ((next & 0xC0) != 0x80)
            return 0;
        code = code << 6 | (next & 0x3Fu);
    }
    const bool is_surrogate = code >= 0xD800 && code < 0xE000;
    return code < least[count] || is_surrogate || code > 0x10FFFF || lead > 0xF4 ? 0 : count;
}

bool text_is_utf8(const char *text)
{
    while (*text != '\0') {
        const size_t count = utf8_bytes(text);
        if (count == 0)
            return false;
        text += count;
    }
    return true;
}

void text_make_utf8(char *text)
{
    while (*text != '\0') {
        const size_t count = utf8_bytes(text);
        if (count == 0)
            *text = '?';
        text += count > 0 ? count : 1;
    }
}

bool text_to_u64(uint64_t *value, const char *text)
{
    uint64_t sum = 0;
    if (*text == '\0')
        return false;
    for (; *text != '\0'; text++) {
        if (!isdigit((unsigned char)*text))
            return false;
        const uint64_t digit = (uint64_t)(*text - '0');
        if (sum > (UINT64_MAX - digit) / 10)
            return false;
        sum = sum * 10 + digit;
    }
    *value = sum;
    return true;
}

bool text_to_double(double *value, const char *text)
{
    char *end = NULL;
    /* Keeps out white space, hexadecimal, "inf" and "nan", which strtod takes. */
    if (*text == '\0' || text[strspn(text, "0123456789+-.eE")] != '\0')
        return false;
    const locale_t c_locale = newlocale(LC_ALL_MASK, "C", (locale_t)0);
    if (c_locale == (locale_t)0)
        return false;
    const double number = strtod_l(text, &end, c_locale);
    freelocale(c_locale);
    if (*end != '\0' || end == text || !isfinite(number))
        return false;
    *value = number;
    return true;
}

void text_from_double(char text[32], double value)
{
    const locale_t c_locale = newlocale(LC_ALL_MASK, "C", (locale_t)0);
    const locale_t before = c_locale != (locale_t)0 ? uselocale(c_locale) : (locale_t)0;
    for (int digits = DBL_DIG; digits <= DBL_DECIMAL_DIG; digits++) {
        double again = 0;
        snprintf(text, 32, "%.*g", digits, value);
        if (text_to_double(&again, text) && again >= value && again <= value)
            break;
    }
    if (c_locale != (locale_t)0) {
        uselocale(before);
        freelocale(c_locale);
    }
}
