#include "parent_kit.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static void stop(const char *why)
{
    fprintf(stderr, "%s\n", why);
    abort();
}

void parent_kit_open(parent_kit *kit)
{
    static const char *const ids[KIT_CASES] = { "a6c7aedeb327fda0", "2590a603dfb28963" };
    fm_error err = { 0 };
    *kit = (parent_kit){ .folder = "/tmp/fragmark-fuzz-XXXXXX" };
    if (mkdtemp(kit->folder) == NULL)
        stop("no folder");
    for (size_t i = 0; i < KIT_CASES; i++) {
        fm_case *of = &kit->cases[i];
        strcpy(of->id, ids[i]);
        strcpy(of->method, "kb");
        strcpy(of->scene, "layers");
        strcpy(of->device, "vulkan");
        strcpy(of->feed, "raster");
        settings_default(&of->settings);
    }
    kit->plan = (fm_plan){
        .cases = kit->cases, .count = KIT_CASES, .launches = KIT_LAUNCHES, .frames = KIT_FRAMES
    };
    if (results_create(&kit->results, &kit->plan, &kit->plugins, kit->folder, "0123456789abcdef",
                       &err) != FM_OK)
        stop(err.message);
}

void parent_kit_close(parent_kit *kit)
{
    static const char *const names[] = { "samples.csv", "summary.csv", "journal.jsonl" };
    char path[128];
    results_destroy(kit->results);
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        snprintf(path, sizeof path, "%s/%s", kit->folder, names[i]);
        unlink(path);
    }
    if (rmdir(kit->folder) != 0)
        stop("something else was left in the folder");
}
