#include "scan.h"

#include <inttypes.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

fm_status scan_open(fm_scan *scan, const fm_file_bytes *file, fm_error *err)
{
    const char *start = file->bytes;
    *scan = (fm_scan){ .path = file->path, .end = file->bytes + file->count };
    if (file->count >= 2 &&
        (memcmp(start, "\xFF\xFE", 2) == 0 || memcmp(start, "\xFE\xFF", 2) == 0))
        return fm_fail(err, FM_INVALID, "%s: UTF-16; only UTF-8 is read", file->path);
    if (file->count >= 3 && memcmp(start, "\xEF\xBB\xBF", 3) == 0)
        start += 3;
    scan->at = scan->line_end = scan->next = start;
    scan->locale = newlocale(LC_ALL_MASK, "C", (locale_t)0);
    if (scan->locale == (locale_t)0)
        return fm_fail(err, FM_NO_MEMORY, "no memory for a locale");
    return FM_OK;
}

void scan_close(fm_scan *scan)
{
    if (scan->locale != (locale_t)0)
        freelocale(scan->locale);
    *scan = (fm_scan){ 0 };
}

static bool is_line_end(char c)
{
    return c == '\n' || c == '\r';
}

static const char *behind_line_end(const char *at, const char *end)
{
    if (at < end && *at == '\r')
        return at + 1 < end && at[1] == '\n' ? at + 2 : at + 1;
    return at < end ? at + 1 : at;
}

static void take_line(fm_scan *scan)
{
    const char *stop = scan->next;
    scan->at = stop;
    scan->line += 1 + scan->joints;
    scan->joints = 0;
    for (;;) {
        while (stop < scan->end && !is_line_end(*stop))
            stop++;
        scan->next = behind_line_end(stop, scan->end);
        if (!scan->joins || stop == scan->at || stop[-1] != '\\' || scan->next == scan->end)
            break;
        scan->joints++;
        stop = scan->next;
    }
    scan->line_end = stop;
}

/* Line ends and their backslashes within a line are joints. */
static bool is_blank(const fm_scan *scan, const char *at)
{
    if (*at == ' ' || *at == '\t' || *at == '\v' || *at == '\f' || is_line_end(*at))
        return true;
    return scan->joins && *at == '\\' && (at + 1 == scan->line_end || is_line_end(at[1]));
}

bool scan_has_word(fm_scan *scan)
{
    while (scan->at < scan->line_end && is_blank(scan, scan->at))
        scan->at++;
    if (scan->at < scan->line_end && *scan->at == '#')
        scan->at = scan->line_end;
    return scan->at < scan->line_end;
}

bool scan_line(fm_scan *scan)
{
    while (scan->next < scan->end) {
        take_line(scan);
        if (scan_has_word(scan))
            return true;
    }
    scan->at = scan->line_end;
    return false;
}

bool scan_word(fm_word *word, fm_scan *scan)
{
    if (!scan_has_word(scan))
        return false;
    word->bytes = scan->at;
    while (scan->at < scan->line_end && !is_blank(scan, scan->at))
        scan->at++;
    word->length = (size_t)(scan->at - word->bytes);
    return true;
}

bool scan_word_on(fm_word *word, fm_scan *scan)
{
    return scan_word(word, scan) || (scan_line(scan) && scan_word(word, scan));
}

bool scan_is_open_line(const fm_scan *scan)
{
    return scan->next == scan->end && scan->line_end == scan->end;
}

bool word_is(fm_word word, const char *text)
{
    return strlen(text) == word.length && memcmp(word.bytes, text, word.length) == 0;
}

bool word_is_any_case(fm_word word, const char *text)
{
    return strlen(text) == word.length && strncasecmp(word.bytes, text, word.length) == 0;
}

bool word_real(double *value, const fm_scan *scan, fm_word word)
{
    char *stop;
    if (memchr(word.bytes, 'x', word.length) != NULL ||
        memchr(word.bytes, 'X', word.length) != NULL)
        return false;
    *value = strtod_l(word.bytes, &stop, scan->locale);
    return stop == word.bytes + word.length;
}

bool word_integer(int64_t *value, fm_word word)
{
    char *stop;
    *value = strtoll(word.bytes, &stop, 10);
    return word.length > 0 && stop == word.bytes + word.length;
}

fm_status scan_fail(const fm_scan *scan, fm_error *err, const char *format, ...)
{
    char reason[512];
    va_list values;
    va_start(values, format);
    vsnprintf(reason, sizeof reason, format, values);
    va_end(values);
    return fm_fail(err, FM_INVALID, "%s:%" PRIu64 ": %s", scan->path, scan->line, reason);
}

typedef bool next_word(fm_word *word, fm_scan *scan);

static fm_status take_reals(double *values, int count, fm_scan *scan, next_word *next,
                            const char *what, fm_error *err)
{
    fm_word word;
    for (int i = 0; i < count; i++) {
        if (!next(&word, scan))
            return scan_fail(scan, err, "%s of %d numbers, not %d%s", what, i, count,
                             scan_is_open_line(scan) ? ": is the file cut off?" : "");
        if (!word_real(&values[i], scan, word))
            return scan_fail(scan, err, "%s: '%.*s' is not a number", what, WORD_TEXT(word));
    }
    return FM_OK;
}

fm_status scan_reals(double *values, int count, fm_scan *scan, const char *what, fm_error *err)
{
    return take_reals(values, count, scan, scan_word, what, err);
}

fm_status scan_reals_on(double *values, int count, fm_scan *scan, const char *what, fm_error *err)
{
    return take_reals(values, count, scan, scan_word_on, what, err);
}
