#include "shader_fault.h"

#include <stdio.h>
#include <string.h>

enum { LOG_MAX_BYTES = 1024, QUOTE_MAX_BYTES = 200 }; /* so that both fit into an fm_error */

/* Copies line number `line`, from 1, without its indentation. */
static void quote_line(char quote[QUOTE_MAX_BYTES], const char *source, unsigned line)
{
    const char *at = source;
    for (unsigned i = 1; i < line && at != NULL; i++) {
        at = strchr(at, '\n');
        at = at != NULL ? at + 1 : NULL;
    }
    if (at == NULL)
        at = "";
    at += strspn(at, " \t");
    snprintf(quote, QUOTE_MAX_BYTES, "%.*s", (int)strcspn(at, "\n"), at);
}

fm_status device_fail_shader(fm_error *err, const fm_shader_fault *fault)
{
    char quote[QUOTE_MAX_BYTES];
    if (fault->line == 0)
        return fm_fail(err, FM_SHADER, "%s: %s shader: %.*s", fault->pipeline, fault->stage,
                       LOG_MAX_BYTES, fault->log);
    quote_line(quote, fault->source, fault->line);
    return fm_fail(err, FM_SHADER, "%s: %s shader, line %u: '%s'\n%.*s", fault->pipeline,
                   fault->stage, fault->line, quote, LOG_MAX_BYTES, fault->log);
}
