/* A worker's answer as its parent takes it: what passes becomes rows. */
#include <jansson.h>
#include <stdlib.h>
#include <unistd.h>

#include "fuzz.h"
#include "parent_kit.h"
#include "results/answer_check.h"

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t count)
{
    fm_error err = { 0 };
    json_t *answer = json_loadb((const char *)bytes, count, JSON_REJECT_DUPLICATES, NULL);
    if (answer == NULL)
        return 0;
    const fm_status status = answer_check(answer, KIT_FRAMES, &err);
    fuzz_expect_reason(status, &err);
    if (status == FM_OK) {
        parent_kit kit;
        parent_kit_open(&kit);
        results_take_mesh(kit.results, answer);
        fuzz_expect_reason(results_add(kit.results, 0, 0, answer, &err), &err);
        fuzz_expect_reason(results_end(kit.results, &err), &err);
        parent_kit_close(&kit);
    }
    json_decref(answer);
    return 0;
}
