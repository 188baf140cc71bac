#include "missing.h"

#include <errno.h>
#include <jansson.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/path.h"

/* How every line of a journal begins and ends (results/journal.h). */
static const char line_start[] = "{\"event\":\"";

static fm_status add(fm_text_list *missing, const char *sentence, fm_error *err)
{
    return text_list_add(missing, sentence)
               ? FM_OK
               : fm_fail(err, FM_NO_MEMORY, "no memory for what is missing");
}

static fm_status find_samples(fm_text_list *missing, const fm_result_files *results, fm_error *err)
{
    char sentence[256];
    size_t measured = 0, without = 0;
    for (size_t i = 0; i < results->count; i++) {
        const size_t *first = results->samples.first + i;
        measured += results->cases[i].is_measured;
        without += results->cases[i].is_measured && first[0] == first[1];
    }
    if (results->sample_table != NULL && without == 0)
        return FM_OK;
    if (results->sample_table == NULL)
        snprintf(sentence, sizeof sentence,
                 "samples.csv is not there: what needs single frames or launches is left out");
    else
        snprintf(sentence, sizeof sentence,
                 "samples.csv has no row of %zu of %zu measured cases: what needs their single "
                 "frames or launches is left out",
                 without, measured);
    return add(missing, sentence, err);
}

static bool is_line(const char *text, size_t length, size_t number)
{
    const size_t start = sizeof line_start - 1;
    const bool has_form = length > start + 2 && strncmp(text, line_start, start) == 0 &&
                          text[length - 2] == '}' && strlen(text) == length;
    return has_form && (number > 1 || strncmp(text + start, "plan\"", 5) == 0);
}

/* The number of the first line that is damaged; 0: none. */
static size_t damaged_line(FILE *journal)
{
    char *text = NULL;
    size_t room = 0, number = 0;
    ssize_t length;
    bool is_good = true;
    while (is_good && (length = getline(&text, &room, journal)) > 0) {
        number++;
        is_good = text[length - 1] != '\n' || is_line(text, (size_t)length, number);
    }
    free(text);
    return is_good ? 0 : number;
}

static fm_status find_journal(fm_text_list *missing, const char *directory, fm_error *err)
{
    char path[FM_PATH_MAX_BYTES], sentence[FM_PATH_MAX_BYTES + 160];
    fm_status status = path_join(path, directory, "journal.jsonl", err);
    if (status != FM_OK)
        return status;
    FILE *journal = fopen(path, "rbe");
    if (journal == NULL && errno == ENOENT)
        return FM_OK;
    if (journal == NULL)
        return fm_fail(err, FM_IO, "%s: %s", path, strerror(errno));
    const size_t line = damaged_line(journal);
    fclose(journal);
    if (line == 0)
        return FM_OK;
    snprintf(sentence, sizeof sentence,
             "journal.jsonl is damaged in line %zu: the run cannot be continued, and what it "
             "measured after that line may be missing here",
             line);
    return add(missing, sentence, err);
}

/* What a merge of shards said when it was made. */
static fm_status find_shards(fm_text_list *missing, const fm_provenance *manifest, fm_error *err)
{
    const json_t *merged = manifest != NULL ? json_object_get(manifest->json, "merged") : NULL;
    const json_t *sentence;
    size_t i;
    fm_status status = FM_OK;
    json_array_foreach(json_object_get(merged, "missing"), i, sentence)
    {
        if (status == FM_OK && json_is_string(sentence))
            status = add(missing, json_string_value(sentence), err);
    }
    return status;
}

fm_status missing_find(fm_text_list *missing, const fm_result_files *results, fm_error *err)
{
    fm_status status = find_samples(missing, results, err);
    if (status == FM_OK)
        status = find_shards(missing, results->manifest, err);
    return status == FM_OK ? find_journal(missing, results->directory, err) : status;
}
