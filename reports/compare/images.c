#include "images.h"

#include <errno.h>
#include <jansson.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/path.h"

/* Of a case that drew more than one picture; no hash is like it. */
static const char several[FM_IMAGE_HASH_BYTES] = "several";

static bool is_hash(const char *text)
{
    return text != NULL && strlen(text) == FM_IMAGE_HASH_BYTES - 1 &&
           strspn(text, "0123456789abcdef") == FM_IMAGE_HASH_BYTES - 1;
}

static void add_hash(char hash[FM_IMAGE_HASH_BYTES], const char *drawn)
{
    if (!is_hash(drawn) || strcmp(hash, drawn) == 0)
        return;
    memcpy(hash, hash[0] == '\0' ? drawn : several, strlen(hash[0] == '\0' ? drawn : several) + 1);
}

/* A line that ends a launch of a case, or forgets what the case had. */
static void take_line(fm_images *images, const fm_result_files *results, const json_t *line)
{
    const char *event = json_string_value(json_object_get(line, "event"));
    const char *id = json_string_value(json_object_get(line, "case"));
    const size_t index =
        event != NULL && id != NULL ? text_index_find(&results->ids, id) : FM_TEXT_INDEX_NONE;
    if (index == FM_TEXT_INDEX_NONE)
        return;
    if (strcmp(event, "forget") == 0)
        images->hashes[index][0] = '\0';
    if (strcmp(event, "end") != 0)
        return;
    const json_t *drawn = json_object_get(json_object_get(line, "result"), "image_hashes");
    for (size_t i = 0; i < json_array_size(drawn); i++)
        add_hash(images->hashes[index], json_string_value(json_array_get(drawn, i)));
}

static fm_status take_lines(fm_images *images, const fm_result_files *results, FILE *journal,
                            const char *path, fm_error *err)
{
    char *text = NULL;
    size_t room = 0;
    ssize_t length;
    while ((length = getline(&text, &room, journal)) > 0) {
        json_t *line = json_loadb(text, (size_t)length, 0, NULL);
        take_line(images, results, line);
        json_decref(line);
    }
    const int why = errno; /* of a line that ended before the file did */
    free(text);
    for (size_t i = 0; i < results->count; i++)
        if (strcmp(images->hashes[i], several) == 0)
            images->hashes[i][0] = '\0';
    return feof(journal)
               ? FM_OK
               : fm_fail(err, why == ENOMEM ? FM_NO_MEMORY : FM_IO, "%s: %s", path, strerror(why));
}

fm_status images_read(fm_images *images, const fm_result_files *results, fm_error *err)
{
    char path[FM_PATH_MAX_BYTES];
    *images = (fm_images){ NULL };
    const fm_status status = path_join(path, results->directory, "journal.jsonl", err);
    if (status != FM_OK)
        return status;
    images->hashes = calloc(results->count + 1, sizeof *images->hashes);
    if (images->hashes == NULL)
        return fm_fail(err, FM_NO_MEMORY, "no memory for %zu cases", results->count);
    FILE *journal = fopen(path, "rbe");
    if (journal == NULL)
        return errno == ENOENT ? FM_OK : fm_fail(err, FM_IO, "%s: %s", path, strerror(errno));
    const fm_status taken = take_lines(images, results, journal, path, err);
    fclose(journal);
    return taken;
}

void images_free(fm_images *images)
{
    free(images->hashes);
    *images = (fm_images){ NULL };
}
