#include "bundle_papers.h"

#include <gnu/libc-version.h>
#include <jansson.h>
#include <stdlib.h>
#include <string.h>
#include <sys/utsname.h>
#include <time.h>

#include "base/data.h"
#include "items_json.h"
#include "parent/manifest.h"

static json_t *ids_json(const fm_text_list *ids)
{
    json_t *list = json_array();
    for (size_t i = 0; i < ids->count; i++)
        json_array_append_new(list, json_string(ids->items[i]));
    return list;
}

static fm_status write_manifest(const char *root, const bundle_items *items,
                                const fm_text_list *ids, const char *machine, fm_error *err)
{
    char path[FM_PATH_MAX_BYTES], made[32];
    struct tm utc;
    const time_t now = time(NULL);
    gmtime_r(&now, &utc);
    strftime(made, sizeof made, "%Y-%m-%dT%H:%M:%SZ", &utc);
    fm_status status = path_join(path, root, DATA_BUNDLE_MANIFEST, err);
    json_t *manifest =
        json_pack("{s:i, s:s, s:s, s:s, s:s, s:s, s:o, s:o}", "schema", 1, "fragmark", FM_VERSION,
                  "git_commit", manifest_commit(), "made", made, "machine", machine, "glibc",
                  gnu_get_libc_version(), "methods", ids_json(ids), "files", items_json(items));
    char *text = manifest != NULL ? json_dumps(manifest, JSON_INDENT(1)) : NULL;
    if (status == FM_OK)
        status = text != NULL ? text_write_file(path, text, strlen(text), err)
                              : fm_fail(err, FM_NO_MEMORY, "%s: no memory", path);
    free(text);
    json_decref(manifest);
    return status;
}

static const char readme[] =
    "fragmark %s, to be measured with on a machine without packages. bundle.json lists the files,\n"
    "where they come from, and their XXH3 hashes.\n"
    "\n"
    "It needs Linux on %s with glibc %s or newer, and the driver of the machine's GPU. It needs "
    "no\n"
    "root. Copy this folder there, under any name, then:\n"
    "\n"
    "  bin/fragmark doctor\n"
    "  bin/fragmark run --method all -a n=16 -o out\n"
    "\n"
    "If doctor finds no Vulkan device, name the driver's file, for example:\n"
    "  VK_DRIVER_FILES=/etc/vulkan/icd.d/nvidia_icd.json bin/fragmark doctor\n"
    "\n"
    "There is no fragmark-report here. Copy the results back, and draw them there:\n"
    "  fragmark report out\n"
    "\n"
    "The device osmesa needs the machine's own libOSMesa. If a driver says that libstdc++ is too\n"
    "old, remove lib/fragmark/lib/libstdc++.so.6 here; then the machine's own is used.\n";

fm_status bundle_write_papers(const char *root, const bundle_items *items, const fm_text_list *ids,
                              fm_error *err)
{
    char path[FM_PATH_MAX_BYTES];
    fm_text text = { 0 };
    struct utsname system = { 0 };
    uname(&system);
    fm_status status = write_manifest(root, items, ids, system.machine, err);
    if (status == FM_OK)
        status = path_join(path, root, "README", err);
    text_add(&text, readme, FM_VERSION, system.machine, gnu_get_libc_version());
    if (status == FM_OK)
        status = text.failed ? fm_fail(err, FM_NO_MEMORY, "%s: no memory", path)
                             : text_write_file(path, text.bytes, text.length, err);
    text_free(&text);
    return status;
}
