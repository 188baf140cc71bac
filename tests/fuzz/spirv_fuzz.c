/* SPIR-V that is to count its accesses. */
#include <stdlib.h>
#include <string.h>

#include "fuzz.h"
#include "spirv/accesses.h"

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t count)
{
    static const spirv_resource resources[] = {
        { .binding = 2, .length_offset = 8 },
        { .by_address = true, .address_offset = 16, .length_offset = 24 },
        { .binding = 3, .texel_bytes = 4 },
    };
    static const spirv_counting counting = {
        .resources = resources, .resource_count = 3, .table_binding = 1, .counters_binding = 9
    };
    const size_t word_count = count / sizeof(uint32_t);
    uint32_t *words = malloc(count + 1), *counted = NULL;
    size_t counted_words = 0;
    fm_error err = { 0 };
    if (words == NULL)
        return 0;
    memcpy(words, bytes, word_count * sizeof *words);
    fuzz_expect_reason(
        spirv_count_accesses(&counted, &counted_words, words, word_count, &counting, &err), &err);
    free(counted);
    free(words);
    return 0;
}
