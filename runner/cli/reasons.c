/* Why cases of a run have no time, from its summary.csv. */
#include <stdlib.h>
#include <string.h>

#include "cli.h"

enum { SUMMARY_MOST_BYTES = 64 << 20, REASONS_MOST = 8, REASON_BYTES = 600 };
enum { COLUMN_STATUS = 2, COLUMN_MESSAGE, COLUMN_METHOD, COLUMNS_READ };

/* Takes the next field out of a line, in place, and moves *at behind its comma. */
static char *next_field(char **at)
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

static char *line_end(char *at)
{
    bool is_quoted = false;
    for (; *at != '\0' && (is_quoted || *at != '\n'); at++)
        is_quoted ^= *at == '"';
    return at;
}

static void add_reason(fm_text_list *reasons, size_t *left_out, char *line)
{
    char reason[REASON_BYTES], *fields[COLUMNS_READ];
    for (size_t i = 0; i < COLUMNS_READ; i++)
        fields[i] = next_field(&line);
    if (strcmp(fields[COLUMN_STATUS], "ok") == 0 || strcmp(fields[COLUMN_STATUS], "skipped") == 0 ||
        fields[COLUMN_MESSAGE][0] == '\0')
        return;
    snprintf(reason, sizeof reason, "%s: %s: %s", fields[COLUMN_METHOD], fields[COLUMN_STATUS],
             fields[COLUMN_MESSAGE]);
    if (text_list_has(reasons, reason))
        return;
    if (reasons->count == REASONS_MOST || !text_list_add(reasons, reason))
        ++*left_out;
}

void cli_reasons(FILE *talk, const char *directory)
{
    char path[FM_PATH_MAX_BYTES + 16], *bytes = NULL;
    size_t count = 0, left_out = 0;
    fm_text_list reasons = { 0 };
    fm_error err = { 0 };
    snprintf(path, sizeof path, "%s/summary.csv", directory);
    if (text_read_file(&bytes, &count, path, SUMMARY_MOST_BYTES, &err) != FM_OK)
        return; /* the run itself has said what is wrong */
    for (char *end = line_end(bytes); *end == '\n' && end[1] != '\0';) {
        char *line = end + 1;
        end = line_end(line);
        const char stop = *end;
        *end = '\0';
        add_reason(&reasons, &left_out, line);
        *end = stop;
    }
    for (size_t i = 0; i < reasons.count; i++)
        fprintf(talk, "  %s\n", reasons.items[i]);
    if (left_out > 0)
        fprintf(talk, "  ... and %zu more in %s\n", left_out, path);
    text_list_free(&reasons);
    free(bytes);
}
