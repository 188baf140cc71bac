/* Plans and plugin lists by hand, and folders that go away: for tests of the parent process. */
#ifndef FM_TESTS_FAKE_PLAN_H
#define FM_TESTS_FAKE_PLAN_H

#include <ftw.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "plan/plan.h"

enum { FAKE_CASES = 8 };

typedef struct fake_plan {
    char folder[64];                        /* temporary */
    char worker[96];                        /* path of a script in it */
    fm_method_desc methods[FAKE_CASES + 1]; /* the last is the floor */
    fm_plugin plugins[FAKE_CASES + 1];
    fm_plugin_entry entries[FAKE_CASES + 1];
    fm_plugin_list list;
    fm_case cases[FAKE_CASES];
    fm_plan plan;
} fake_plan;

static inline void fake_plugin(fake_plan *fake, size_t i, const char *id, uint32_t traits)
{
    fm_plugin_entry *entry = &fake->entries[i];
    snprintf(entry->id, sizeof entry->id, "%s", id);
    fake->methods[i] = (fm_method_desc){ .abi = FM_ABI,
                                         .size_bytes = sizeof(fm_method_desc),
                                         .id = entry->id,
                                         .title = "Fake",
                                         .version = "7",
                                         .traits = traits };
    fake->plugins[i].method = &fake->methods[i];
    snprintf(fake->plugins[i].path, sizeof fake->plugins[i].path, "/fake/%s.so", id);
    entry->plugin = &fake->plugins[i];
}

/* One case for each id; ids in alphabetical order, before "z-floor". Methods are exact. */
static inline void fake_open(fake_plan *fake, const char *const *ids, uint32_t launches)
{
    size_t count = 0;
    *fake = (fake_plan){ .folder = "/tmp/fragmark-test-XXXXXX" };
    if (mkdtemp(fake->folder) == NULL)
        abort();
    snprintf(fake->worker, sizeof fake->worker, "%s/worker.sh", fake->folder);
    for (; ids[count] != NULL; count++) {
        fm_case *of = &fake->cases[count];
        fake_plugin(fake, count, ids[count], FM_TRAIT_EXACT);
        snprintf(of->id, sizeof of->id, "%016zx", count + 1);
        snprintf(of->method, sizeof of->method, "%s", ids[count]);
        snprintf(of->scene, sizeof of->scene, "layers");
        snprintf(of->device, sizeof of->device, "dummy:0");
        snprintf(of->feed, sizeof of->feed, "raster");
        settings_default(&of->settings);
        of->settings.n = 4;
    }
    fake_plugin(fake, count, "z-floor", FM_TRAIT_CONTROL | FM_TRAIT_FLOOR);
    fake->list = (fm_plugin_list){ .entries = fake->entries, .count = count + 1 };
    fake->plan = (fm_plan){ .cases = fake->cases,
                            .count = count,
                            .seed = 1,
                            .launches = launches,
                            .frames = 2,
                            .warmup = 1 };
}

static inline int fake_remove(const char *path, const struct stat *info, int kind,
                              struct FTW *level)
{
    (void)info, (void)kind, (void)level;
    return remove(path);
}

static inline void fake_close(fake_plan *fake)
{
    nftw(fake->folder, fake_remove, 16, FTW_DEPTH | FTW_PHYS);
}

/* The whole of FOLDER/name; the caller frees it. NULL: no such file. */
static inline char *fake_read(const fake_plan *fake, const char *name)
{
    char path[256], *bytes = NULL;
    size_t count = 0;
    snprintf(path, sizeof path, "%s/%s", fake->folder, name);
    return text_read_file(&bytes, &count, path, 1u << 24, NULL) == FM_OK ? bytes : NULL;
}

static inline void fake_write(const fake_plan *fake, const char *name, const char *text,
                              const char *mode)
{
    char path[256];
    snprintf(path, sizeof path, "%s/%s", fake->folder, name);
    FILE *file = fopen(path, mode);
    if (file == NULL || fputs(text, file) < 0 || fclose(file) != 0)
        abort();
}

#endif
