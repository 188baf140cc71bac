/* A descriptor as another process hands it over. One that is taken holds what the parent asks of
 * descriptors. Seeds: what `fragmark describe` answers, without the head. */
#include <stdlib.h>

#include "describe/description.h"
#include "fuzz.h"
#include "model/descriptor.h"
#include "model/formula.h"
#include "plugin/plugin.h"

static const char *first_value(const fm_workload *workload, const char *name)
{
    const fm_option *option = option_find(workload->runner, name);
    return option != NULL ? option->values[0] : NULL;
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t count)
{
    const fm_method_desc *method;
    void *memory;
    uint64_t totals[FM_MAX_TOTALS] = { 0 };
    fm_error err = { 0 };
    const fm_status status = description_read(&method, &memory, bytes, count, "x.so", &err);
    fuzz_expect_reason(status, &err);
    if (status != FM_OK)
        return 0;
    const fm_workload workload = { .width_px = 3,
                                   .height_px = 2,
                                   .k = 4,
                                   .n = 5,
                                   .totals = totals,
                                   .option = first_value,
                                   .runner = method };
    if (method->technique == NULL)
        (void)formula_bytes(method, &workload);
    if (plugin_check(method, "x.so", &err) != FM_OK)
        abort();
    free(memory);
    return 0;
}
