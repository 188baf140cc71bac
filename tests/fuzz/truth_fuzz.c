/* A truth that opens is walked through. */
#include "fuzz.h"
#include "truth/truth.h"

static void walk(const fm_truth *truth)
{
    const uint64_t pixels = (uint64_t)truth->width_px * truth->height_px;
    double rgba[4];
    truth_digest(truth);
    truth_kept(truth, 3);
    for (uint64_t i = 0; i < pixels; i++)
        composite_pixel(rgba, truth->fragments + truth->offsets[i],
                        truth->offsets[i + 1] - truth->offsets[i]);
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t count)
{
    fuzz_file file;
    fm_truth *truth = NULL;
    fm_error err = { 0 };
    fuzz_file_open(&file, bytes, count);
    const fm_status status = truth_open(&truth, file.path, &err);
    fuzz_expect_reason(status, &err);
    if (status == FM_OK)
        walk(truth);
    truth_close(truth);
    fuzz_file_close(&file);
    return 0;
}
