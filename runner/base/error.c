#include "error.h"

#include <assert.h>
#include <errno.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

__attribute__((format(printf, 4, 0))) static void
fill(fm_error *err, fm_status status, fm_reason reason, const char *format, va_list arguments)
{
    if (err == NULL)
        return;
    err->status = status;
    err->reason = reason;
    err->is_own = false;
    vsnprintf(err->message, sizeof err->message, format, arguments);
}

fm_status fm_fail(fm_error *err, fm_status status, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    fill(err, status, FM_REASON_NONE, format, arguments);
    va_end(arguments);
    return status;
}

fm_status fm_refuse(fm_error *err, fm_reason reason, const char *format, ...)
{
    va_list arguments;
    assert(reason > FM_REASON_NONE && reason < FM_REASON_COUNT);
    va_start(arguments, format);
    fill(err, FM_UNSUPPORTED, reason, format, arguments);
    va_end(arguments);
    return FM_UNSUPPORTED;
}

fm_status fm_error_refuse(fm_error *err, fm_status status, fm_reason reason)
{
    assert(reason > FM_REASON_NONE && reason < FM_REASON_COUNT);
    if (status != FM_INVALID && status != FM_IO)
        return status;
    if (err != NULL) {
        err->status = FM_UNSUPPORTED;
        err->reason = reason;
    }
    return FM_UNSUPPORTED;
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

bool fm_error_is_the_worlds(const fm_error *err)
{
    static const int causes[] = { ENOSPC, EDQUOT, EFBIG, EMFILE, ENFILE, EROFS, EIO };
    for (size_t i = 0; i < sizeof causes / sizeof causes[0]; i++)
        if (strstr(err->message, strerror(causes[i])) != NULL)
            return true;
    return false;
}
