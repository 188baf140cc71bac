#include "error.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

fm_status fm_fail(fm_error *err, fm_status status, const char *format, ...)
{
    if (err == NULL)
        return status;
    err->status = status;
    err->is_own = false;
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(err->message, sizeof err->message, format, arguments);
    va_end(arguments);
    return status;
}

fm_status fm_error_prefix(fm_error *err, const char *format, ...)
{
    char prefix[512], below[sizeof err->message];
    va_list arguments;
    if (err == NULL)
        return FM_INVALID;
    va_start(arguments, format);
    vsnprintf(prefix, sizeof prefix, format, arguments);
    va_end(arguments);
    memcpy(below, err->message, sizeof below);
    snprintf(err->message, sizeof err->message, "%s: %.*s", prefix,
             (int)(sizeof below - sizeof prefix - 2), below); /* and ": " */
    return err->status;
}
