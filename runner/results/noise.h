/* Whether a case was measured in peace: what marks rows in column `noisy`.
 *
 * On a software device, threads that are ready and have no processor take time from a frame. A row
 * is noisy if its launches spent more than NOISE_WAITED_SHARE of the time that their threads could
 * have run waiting (median of the launches, because the row's times are medians). On a GPU the
 * host's processors do not do the work. On any device it is noisy if, in half of the launches, the
 * limit of their control group stopped them for more than NOISE_THROTTLED_SHARE of the timed
 * frames, or heat slowed a processor. Whatever the reason, launches whose frame times differ by
 * more than NOISE_SPREAD are no repetitions of one another. */
#ifndef FM_NOISE_H
#define FM_NOISE_H

#include "base/text.h"
#include "results.h"

#define NOISE_WAITED_SHARE    0.2
#define NOISE_THROTTLED_SHARE 0.05
#define NOISE_SPREAD          1.5

/* Adds the reasons, with "; " between them; nothing: the case was measured in peace, as far as the
 * system tells. frame_ms: [launches], the median of each; NAN: it has none. */
void noise_reasons(fm_text *text, const fm_case_result *result, uint32_t launches,
                   const double *frame_ms);

/* What all launches of a run say of the host. */
typedef struct fm_noise_host {
    double waited_share; /* median of the launches on software devices; NAN: unknown */
    double load;         /* greatest load average; NAN: unknown */
} fm_noise_host;

/* FM_NO_MEMORY. */
fm_status noise_of_host(fm_noise_host *host, const fm_results *results, fm_error *err);

#endif
