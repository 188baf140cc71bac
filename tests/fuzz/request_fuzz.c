#include "fuzz.h"
#include "worker/protocol.h"

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t count)
{
    fuzz_file file;
    fm_read_request request;
    fm_error err = { 0 };
    fuzz_file_open(&file, bytes, count);
    fuzz_expect_reason(request_read(&request, file.path, &err), &err);
    request_free(&request);
    fuzz_file_close(&file);
    return 0;
}
