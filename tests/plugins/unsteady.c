/* Draws wrong pictures by plan: the first `columns` columns of pixels stay empty, and how many they
 * are hangs on the frame and on the launch, as the option `wrong` says. So the error of each frame
 * is known: it grows with the root of their number. unsteady.glsl has the plan.
 *
 * The launch is what the file that FRAGMARK_TEST_LAUNCHES names counts: each process that runs
 * frames adds a byte to it. */
#include <fcntl.h>
#include <stdint.h>
#include <stdlib.h>
#include <unistd.h>

#include "head.h"

/* How many processes ran frames before this one. */
static unsigned launch_number(void)
{
    static long launch = -1;
    const char *path = getenv("FRAGMARK_TEST_LAUNCHES");
    const int file = launch < 0 && path != NULL
                         ? open(path, O_WRONLY | O_APPEND | O_CREAT | O_CLOEXEC, 0600)
                         : -1;
    if (file >= 0 && write(file, ".", 1) == 1)
        launch = (long)lseek(file, 0, SEEK_CUR) - 1;
    if (file >= 0)
        close(file);
    return launch > 0 ? (unsigned)launch : 0;
}

/* Which of four frames this is, from 0; a frame begins where the loop ran once. */
static unsigned frame_number(uint64_t runs)
{
    static unsigned frames; /* begun so far */
    frames += runs == 1;
    return (frames - 1) % 4;
}

/* The loop runs once, and once more for each frame of four, and four times for each launch. */
static fm_next after(const fm_workload *workload, const char *pass)
{
    (void)pass;
    const uint64_t runs = workload->totals[0];
    return runs <= 4 * launch_number() + frame_number(runs) ? FM_REPEAT : FM_NEXT;
}

const fm_method_desc fm_method = {
    HEAD("unsteady"),
    .keeps = FM_KEEPS_NEAREST,
    .options = { { .name = "wrong", .values = { "0", "1", "2", "3" } } },
    .resources = { NEAREST, { .name = "runs", .extent = { .constant = 1 } } },
    .totals = { { .name = "runs", .resource = "runs", .pass = "run" } },
    .passes = { { .name = "clear",
                  .kind = FM_PASS_CLEAR,
                  .writes = { "nearest" },
                  .clear_word = 0x7F800000u },
                { .name = "clear-runs", .kind = FM_PASS_CLEAR, .writes = { "runs" } },
                { .name = "run",
                  .kind = FM_PASS_PIXELS,
                  .shader = "unsteady-run.glsl",
                  .writes = { "runs" } },
                { .name = "ask", .kind = FM_PASS_HOST },
                { .name = "store",
                  .kind = FM_PASS_SCENE,
                  .shader = "unsteady-store.glsl",
                  .writes = { "nearest" } },
                { .name = "resolve",
                  .kind = FM_PASS_PIXELS,
                  .shader = "unsteady.glsl",
                  .reads = { "nearest", "runs" },
                  .emits = true } },
    .loops = { { .first = "run", .last = "ask", .max = 64 } },
    .after = after,
};
