#include "error.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

static const char *const status_name[] = {
    [FM_OK] = "ok",
    [FM_INVALID] = "invalid",
    [FM_UNSUPPORTED] = "unsupported",
    [FM_NO_MEMORY] = "no memory",
    [FM_IO] = "i/o",
    [FM_SHADER] = "shader",
    [FM_DEVICE_LOST] = "device lost",
};
_Static_assert(sizeof status_name / sizeof status_name[0] == FM_STATUS_COUNT, "one name a status");

const char *fm_status_name(fm_status status)
{
    return status_name[status];
}

fm_status fm_fail(fm_error *err, fm_status status, const char *format, ...)
{
    if (err == NULL)
        return status;
    err->status = status;
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
