/* Draws wrong pictures by plan: the first `columns` columns of pixels stay empty, and how many they
 * are hangs on the frame and on the launch, as the option `wrong` says. So the error of each frame
 * is known: it grows with the root of their number. unsteady.glsl has the plan.
 *
 * The launch is what the file that FRAGMARK_TEST_LAUNCHES names counts: each process that runs
 * frames adds a byte to it. */
#include <fcntl.h>
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

/* The loop runs once, and once more for each launch before this one. */
static fm_next after(const fm_workload *workload, const char *pass)
{
    (void)pass;
    return workload->totals[0] <= launch_number() ? FM_REPEAT : FM_NEXT;
}

const fm_method_desc fm_method = {
    HEAD("unsteady"),
    .keeps = FM_KEEPS_NEAREST,
    .options = { { .name = "wrong", .values = { "0", "1", "2", "3" } } },
    .resources = { NEAREST,
                   { .name = "frames", .extent = { .constant = 1 } },
                   { .name = "launches", .extent = { .constant = 1 } } },
    .totals = { { .name = "launch", .resource = "launches", .pass = "launch" } },
    .passes = { { .name = "clear",
                  .kind = FM_PASS_CLEAR,
                  .writes = { "nearest" },
                  .clear_word = 0x7F800000u },
                { .name = "clear-launch", .kind = FM_PASS_CLEAR, .writes = { "launches" } },
                { .name = "frame",
                  .kind = FM_PASS_PIXELS,
                  .shader = "unsteady-frame.glsl",
                  .writes = { "frames" } },
                { .name = "launch",
                  .kind = FM_PASS_PIXELS,
                  .shader = "unsteady-launch.glsl",
                  .writes = { "launches" } },
                { .name = "ask", .kind = FM_PASS_HOST },
                { .name = "store",
                  .kind = FM_PASS_SCENE,
                  .shader = "unsteady-store.glsl",
                  .writes = { "nearest" } },
                { .name = "resolve",
                  .kind = FM_PASS_PIXELS,
                  .shader = "unsteady.glsl",
                  .reads = { "nearest", "frames", "launches" },
                  .emits = true } },
    .loops = { { .first = "launch", .last = "ask", .max = 64 } },
    .after = after,
};
