/* Whether a method that is declared exact was exact; of others wrong images are data. What its
 * traits declare lost is excused, and nothing more. */
#ifndef FM_VERDICT_H
#define FM_VERDICT_H

#include "measure.h"
#include "technique_job.h"

enum { VERDICT_LOSS_BYTES = 128, VERDICT_ACCESSES_BYTES = 1024 };

/* What a launch measured, and what its frames drew; if it was checked, its fragments, too. Where no
 * depths tie all frames draw one image, and that of launch 0 is checked; where some do, each
 * different one was compared with truth. traits: the method's; n: the most fragments of any pixel.
 * Why it is wrong goes to *err, whose status is FM_OK. */
bool verdict_is_wrong(fm_error *err, const fm_measurement *measurement, uint32_t traits,
                      uint32_t n);
/* The same of a technique's sequence; *err also tells of wrong tiles that are no fault. */
bool verdict_frames_are_wrong(fm_error *err, const fm_technique_outcome *outcome, uint32_t traits);
/* "declared loss: 3 fragments at depth 1, 2 of equal depths"; false: none was lost. */
bool verdict_loss(char text[VERDICT_LOSS_BYTES], const fm_check *check);
/* "OUT OF RANGE: 3 accesses beyond the end of 'fragments'", for each resource, and why accesses
 * were not counted; false: there is nothing to tell. */
bool verdict_accesses(char text[VERDICT_ACCESSES_BYTES], const fm_measurement *m);

#endif
