/* devices.json: what is read is above 0, and each device is there once. */
#include <stdlib.h>

#include "bound/limits.h"
#include "fuzz.h"

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t count)
{
    fuzz_file file;
    fm_limits_list list;
    fm_error err = { 0 };
    fuzz_file_open(&file, bytes, count);
    const fm_status status = limits_read(&list, file.path, &err);
    fuzz_expect_reason(status, &err);
    for (size_t i = 0; i < list.count; i++) {
        if (limits_find(&list, &list.items[i].key) != &list.items[i])
            abort();
        for (int j = 0; j < FM_LIMIT_COUNT; j++)
            if (list.items[i].values[j].median <= 0.0)
                abort();
    }
    limits_free(&list);
    fuzz_file_close(&file);
    return 0;
}
