/* A journal is opened and replayed as a run does it, by the checks of a run. If it is refused, its
 * bytes must be what they were. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "fuzz.h"
#include "parent_kit.h"
#include "results/answer_check.h"
#include "results/journal.h"

static fm_status take(void *context, fm_journal_event event, const char *case_id, uint32_t launch,
                      const json_t *result, fm_error *err)
{
    const parent_kit *kit = context;
    size_t i = 0;
    while (i < KIT_CASES && strcmp(kit->cases[i].id, case_id) != 0)
        i++;
    if (i == KIT_CASES || launch >= KIT_LAUNCHES || kit->results->cases[i].launches[launch].is_done)
        return fm_fail(err, FM_INVALID, "no such launch");
    if (event != FM_JOURNAL_END)
        return FM_OK;
    const fm_status status = answer_check(result, KIT_FRAMES, err);
    return status == FM_OK ? results_add(kit->results, i, launch, result, err) : status;
}

static void expect_unchanged(const char *path, const uint8_t *bytes, size_t count)
{
    char *after = NULL;
    size_t after_count = 0;
    if (text_read_file(&after, &after_count, path, SIZE_MAX / 2, NULL) != FM_OK ||
        after_count != count || (count > 0 && memcmp(after, bytes, count) != 0)) {
        fprintf(stderr, "a refused journal was changed\n");
        abort();
    }
    free(after);
}

static void replay(parent_kit *kit, const char *path, const uint8_t *bytes, size_t count)
{
    fm_journal *journal = NULL;
    bool is_damaged = false;
    fm_error err = { 0 };
    const fm_journal_reader reader = { .line = take, .context = kit };
    const fm_journal_plan plan = { .hash = KIT_PLAN_HASH };
    fm_status status = journal_open(&journal, kit->folder, &plan, &is_damaged, &err);
    if (status == FM_OK)
        status = journal_replay(journal, &reader, &is_damaged, &err);
    fuzz_expect_reason(status, &err);
    if (status != FM_OK)
        expect_unchanged(path, bytes, count);
    journal_close(journal);
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t count)
{
    parent_kit kit;
    char path[128];
    parent_kit_open(&kit);
    snprintf(path, sizeof path, "%s/journal.jsonl", kit.folder);
    FILE *file = fopen(path, "wb");
    if (file == NULL || fwrite(bytes, 1, count, file) != count || fclose(file) != 0)
        abort();
    replay(&kit, path, bytes, count);
    parent_kit_close(&kit);
    return 0;
}
