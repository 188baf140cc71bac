#include "items_json.h"

#include <stdlib.h>

#include "base/path.h"
#include "base/text.h"

#define JSON_MAX_BYTES ((size_t)256 << 20)

json_t *items_json(const bundle_items *items)
{
    json_t *files = json_array();
    for (size_t i = 0; i < items->count; i++) {
        const bundle_item *item = &items->items[i];
        json_array_append_new(files, json_pack("{s:s, s:s, s:I, s:s}", "path", item->to, "from",
                                               item->from, "bytes", (json_int_t)item->bytes,
                                               "xxh3_64", item->hash));
    }
    return files;
}

fm_status json_read_object(json_t **json, const char *directory, const char *name, fm_error *err)
{
    char path[FM_PATH_MAX_BYTES], *bytes = NULL;
    size_t count = 0;
    json_error_t fault = { 0 };
    *json = NULL;
    fm_status status = path_join(path, directory, name, err);
    if (status == FM_OK)
        status = text_read_file(&bytes, &count, path, JSON_MAX_BYTES, err);
    if (status != FM_OK)
        return status;
    *json = json_loadb(bytes, count, JSON_REJECT_DUPLICATES, &fault);
    free(bytes);
    if (*json == NULL)
        return fm_fail(err, FM_INVALID, "%s:%d: %s", path, fault.line, fault.text);
    if (json_is_object(*json))
        return FM_OK;
    json_decref(*json);
    *json = NULL;
    return fm_fail(err, FM_INVALID, "%s:1: not a JSON object", path);
}
