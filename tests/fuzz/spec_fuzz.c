#include "fuzz.h"
#include "plan/selection.h"

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t count)
{
    fuzz_file file;
    fm_selection selection;
    fm_error err = { 0 };
    fuzz_file_open(&file, bytes, count);
    const fm_plan_request request = { .spec = file.path };
    const fm_status status = selection_read(&selection, &request, &err);
    fuzz_expect_reason(status, &err);
    if (status == FM_OK)
        selection_free(&selection);
    fuzz_file_close(&file);
    return 0;
}
