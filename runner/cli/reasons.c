/* Why cases of a run have no time, and what is to be known of others, from its summary.csv. */
#include <stdlib.h>
#include <string.h>

#include "base/csv.h"
#include "cli.h"
#include "model/outcome.h"

enum { SUMMARY_MOST_BYTES = 64 << 20, REASONS_MOST = 8, REASON_BYTES = 600 };
enum { COLUMN_STATUS = 2, COLUMN_MESSAGE, COLUMN_METHOD, COLUMNS_READ };

/* What is told of a run: reasons come before notes, whatever the order of rows. */
typedef struct sentences {
    fm_text_list list;
    size_t left_out;
} sentences;

static void add_sentence(sentences *reasons, sentences *notes, char *line)
{
    char sentence[REASON_BYTES], *fields[COLUMNS_READ];
    for (size_t i = 0; i < COLUMNS_READ; i++)
        fields[i] = csv_take_field(&line);
    if (strcmp(fields[COLUMN_STATUS], case_status_name(FM_CASE_SKIPPED)) == 0 ||
        fields[COLUMN_MESSAGE][0] == '\0')
        return;
    const bool is_ok = strcmp(fields[COLUMN_STATUS], case_status_name(FM_CASE_OK)) == 0;
    sentences *to = is_ok ? notes : reasons;
    snprintf(sentence, sizeof sentence, "%s: %s: %s", fields[COLUMN_METHOD], fields[COLUMN_STATUS],
             fields[COLUMN_MESSAGE]);
    if (text_list_has(&to->list, sentence))
        return;
    if (to->list.count == REASONS_MOST || !text_list_add(&to->list, sentence))
        to->left_out++;
}

static void tell(FILE *talk, sentences *told, const char *path)
{
    for (size_t i = 0; i < told->list.count; i++)
        fprintf(talk, "  %s\n", told->list.items[i]);
    if (told->left_out > 0)
        fprintf(talk, "  ... and %zu more in %s\n", told->left_out, path);
    text_list_free(&told->list);
}

void cli_reasons(FILE *talk, const char *directory)
{
    char path[FM_PATH_MAX_BYTES + 16], *bytes = NULL;
    size_t count = 0;
    sentences reasons = { 0 }, notes = { 0 };
    fm_error err = { 0 };
    snprintf(path, sizeof path, "%s/summary.csv", directory);
    if (text_read_file(&bytes, &count, path, SUMMARY_MOST_BYTES, &err) != FM_OK)
        return; /* the run itself has said what is wrong */
    for (char *end = csv_line_end(bytes); *end == '\n' && end[1] != '\0';) {
        char *line = end + 1;
        end = csv_line_end(line);
        const char stop = *end;
        *end = '\0';
        add_sentence(&reasons, &notes, line);
        *end = stop;
    }
    tell(talk, &reasons, path);
    tell(talk, &notes, path);
    free(bytes);
}
