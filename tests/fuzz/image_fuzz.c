#include "fuzz.h"
#include "image/image.h"

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t count)
{
    fuzz_file file;
    fm_image *image = NULL;
    fm_error err = { 0 };
    fuzz_file_open(&file, bytes, count);
    fuzz_expect_reason(image_read(&image, file.path, &err), &err);
    image_destroy(image);
    fuzz_file_close(&file);
    return 0;
}
