#include "fuzz.h"
#include "scene/scene_file.h"

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t count)
{
    fuzz_file file;
    fm_settings settings;
    fm_error err = { 0 };
    settings_default(&settings);
    fuzz_file_open(&file, bytes, count);
    fuzz_expect_reason(scene_file_read(&settings, file.path, &err), &err);
    fuzz_file_close(&file);
    return 0;
}
