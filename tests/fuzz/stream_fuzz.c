/* As many frames as the head says, up to a few; each is checked as a device would. */
#include <string.h>

#include "fuzz.h"
#include "scene/frame_stream.h"

enum { FRAMES = 8 };

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t count)
{
    static const fm_stream_costs costs = { 4, 8, 2.5 };
    fuzz_file file;
    fm_sequence *sequence = NULL;
    fm_error err = { 0 };
    fm_stream_head head = { .frame_count = 1 };
    if (count >= sizeof head)
        memcpy(&head, bytes, sizeof head);
    const uint32_t wanted = head.frame_count < FRAMES ? head.frame_count : FRAMES;
    fuzz_file_open(&file, bytes, count);
    const fm_status status = stream_open(&sequence, file.path, wanted, &costs, &err);
    fuzz_expect_reason(status, &err);
    for (uint32_t i = 0; status == FM_OK && i < wanted; i++) {
        const fm_frame *frame = NULL;
        const fm_status made = sequence->frame(sequence, &frame, i, &err);
        fuzz_expect_reason(made, &err);
        if (made == FM_OK)
            fuzz_expect_reason(frame_check(frame, i, &err), &err);
    }
    sequence_destroy(sequence);
    fuzz_file_close(&file);
    return 0;
}
