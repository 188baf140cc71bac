#include "fuzz.h"
#include "read/provenance.h"

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t count)
{
    fuzz_file file;
    fm_provenance *manifest = NULL;
    fm_error err = { 0 };
    fuzz_file_open(&file, bytes, count);
    fuzz_expect_reason(provenance_read(&manifest, file.path, &err), &err);
    provenance_close(manifest);
    fuzz_file_close(&file);
    return 0;
}
