#include "csv.h"

#include <math.h>
#include <string.h>

void csv_add(fm_text *text, const char *field)
{
    if (field[strcspn(field, "\",\r\n")] == '\0') {
        text_add_raw(text, field, strlen(field));
        return;
    }
    text_add_raw(text, "\"", 1);
    for (; *field != '\0'; field++) {
        if (*field == '"')
            text_add_raw(text, "\"", 1);
        text_add_raw(text, field, 1);
    }
    text_add_raw(text, "\"", 1);
}

void csv_add_real(fm_text *text, double value)
{
    if (isinf(value))
        text_add(text, value > 0 ? "inf" : "-inf");
    else if (!isnan(value))
        text_add(text, "%.9g", value);
}

char *csv_take_field(char **at)
{
    char *in = *at, *out = *at, *field = *at;
    const bool is_quoted = *in == '"';
    in += is_quoted;
    while (*in != '\0' && (is_quoted ? *in != '"' || in[1] == '"' : *in != ',')) {
        in += is_quoted && *in == '"'; /* a doubled quote is one */
        *out++ = *in++;
    }
    in += is_quoted && *in == '"';
    *at = *in == ',' ? in + 1 : in;
    *out = '\0';
    return field;
}

char *csv_line_end(char *at)
{
    bool is_quoted = false;
    for (; *at != '\0' && (is_quoted || *at != '\n'); at++)
        is_quoted ^= *at == '"';
    return at;
}
