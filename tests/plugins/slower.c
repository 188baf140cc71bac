/* A good method that takes longer, by the factor FRAGMARK_TEST_SLOWER, in steps of 5 %, up to 3: it
 * stores the scene 20 times where the factor is 1, and always keeps the same. On the dummy device,
 * which counts nothing, it repeats until it is refused. */
#include <stdlib.h>

#include "head.h"

enum { RUNS = 20, RUNS_MOST = 3 * RUNS };

static fm_next after(const fm_workload *workload, const char *pass)
{
    const char *factor = getenv("FRAGMARK_TEST_SLOWER");
    const double runs = RUNS * (factor != NULL ? atof(factor) : 1.0);
    (void)pass;
    return (double)workload->totals[0] + 0.5 < runs ? FM_REPEAT : FM_NEXT;
}

const fm_method_desc fm_method = {
    HEAD(ID),
    .keeps = FM_KEEPS_NEAREST,
    .resources = { NEAREST, { .name = "runs", .extent = { .constant = 1 } } },
    .totals = { { .name = "runs", .resource = "runs", .pass = "run" } },
    .passes = { { .name = "clear",
                  .kind = FM_PASS_CLEAR,
                  .writes = { "nearest" },
                  .clear_word = 0x7F800000u },
                { .name = "clear-runs", .kind = FM_PASS_CLEAR, .writes = { "runs" } },
                STORE,
                { .name = "run",
                  .kind = FM_PASS_PIXELS,
                  .shader = "unsteady-run.glsl",
                  .writes = { "runs" } },
                { .name = "ask", .kind = FM_PASS_HOST },
                RESOLVE },
    .loops = { { .first = "store", .last = "ask", .max = RUNS_MOST } },
    .after = after,
};
