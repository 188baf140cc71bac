/* Options of a descriptor: names and values, and the macros that shaders see of them. */
#include <stdio.h>
#include <string.h>

#include "base/text.h"
#include "check_method.h"
#include "model/settings.h"

enum { DEFINE_MAX_BYTES = 64, MAX_OPTION_NUMBER = 1 << 20 };

/* NAME_VALUE. */
typedef char define_text[2 * DEFINE_MAX_BYTES];

static bool is_numeric(const fm_option *option, size_t value_count)
{
    double number;
    for (size_t i = 0; i < value_count; i++)
        if (!text_to_double(&number, option->values[i]))
            return false;
    return true;
}

/* Then the option's macro is the number itself, and no value has a macro of its own. */
static bool is_whole(const fm_option *option, size_t value_count)
{
    uint64_t number;
    for (size_t i = 0; i < value_count; i++)
        if (!text_to_u64(&number, option->values[i]))
            return false;
    return true;
}

static fm_status check_value(const char *value, bool is_number, fm_error *err)
{
    char word[DEFINE_MAX_BYTES];
    const int length = snprintf(word, sizeof word, "v%s", value);
    if (length >= (int)sizeof word)
        return fm_fail(err, FM_INVALID, "value '%s': too long", value);
    if (!is_number && !check_is_word(word, "_-"))
        return fm_fail(err, FM_INVALID, "value '%s': needs lower-case letters, digits, '-' and '_'",
                       value);
    return FM_OK;
}

/* Adds NAME or NAME_VALUE as GLSL sees it; FM_INVALID: it is another's macro too. */
static fm_status add_define(define_text *defines, size_t *count, const char *name,
                            const char *value, fm_error *err)
{
    char *define = defines[*count];
    snprintf(define, sizeof(define_text), "%s%s%s", name, *value == '\0' ? "" : "_", value);
    check_fold_name(define);
    if (check_is_taken(define) || strcmp(define, "k") == 0 || strcmp(define, "n") == 0)
        return fm_fail(err, FM_INVALID, "its macro would be '%s', which is reserved", define);
    for (size_t i = 0; i < *count; i++)
        if (strcmp(define, defines[i]) == 0)
            return fm_fail(err, FM_INVALID, "its macro '%s' is there already", define);
    ++*count;
    return FM_OK;
}

static fm_status check_option(const fm_option *option, define_text *defines, size_t *define_count,
                              fm_error *err)
{
    size_t value_count;
    if (!check_is_word(option->name, "_-") || strlen(option->name) >= DEFINE_MAX_BYTES)
        return fm_fail(err, FM_INVALID, "needs lower-case letters, digits, '-' and '_'");
    if (key_find(option->name) != NULL)
        return fm_fail(err, FM_INVALID, "the runner has a key of this name");
    if (option->help != NULL && !text_is_utf8(option->help))
        return fm_fail(err, FM_INVALID, "help: not UTF-8");
    fm_status status = check_list(&value_count, option->values, sizeof option->values[0],
                                  FM_MAX_OPTION_VALUES, "values", err);
    if (status != FM_OK)
        return status;
    if (value_count == 0)
        return fm_fail(err, FM_INVALID, "values: none");
    const bool is_number = is_numeric(option, value_count);
    const bool has_macros = !is_whole(option, value_count);
    status = add_define(defines, define_count, option->name, "", err);
    for (size_t i = 0; i < value_count && status == FM_OK; i++) {
        status = check_value(option->values[i], is_number, err);
        if (status == FM_OK && has_macros)
            status = add_define(defines, define_count, option->name, option->values[i], err);
    }
    return status;
}

fm_status check_options(const fm_checked_method *check, fm_error *err)
{
    define_text defines[FM_MAX_OPTIONS * (FM_MAX_OPTION_VALUES + 1)];
    size_t define_count = 0;
    for (size_t i = 0; i < check->options.count; i++) {
        const fm_option *option = &check->method->options[i];
        if (check_option(option, defines, &define_count, err) != FM_OK)
            return fm_error_prefix(err, "option '%s'", option->name);
    }
    return FM_OK;
}

fm_status check_counting_option(const fm_checked_method *check, const char *name, const char *field,
                                fm_error *err)
{
    size_t index;
    uint64_t number;
    const fm_status status = check_known(&index, name, field, &check->options, err);
    if (status != FM_OK)
        return status;
    const fm_option *option = &check->method->options[index];
    for (size_t i = 0; i < FM_MAX_OPTION_VALUES && option->values[i] != NULL; i++)
        if (!text_to_u64(&number, option->values[i]) || number > MAX_OPTION_NUMBER)
            return fm_fail(err, FM_INVALID, "%s '%s': its value '%s' is no whole number up to %d",
                           field, name, option->values[i], MAX_OPTION_NUMBER);
    return FM_OK;
}
