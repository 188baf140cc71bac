/* What a worker says is checked when it is read, from its own file or from the journal: a worker
 * may hang, crash or lie, and what it says goes into tables that others compute with.
 *
 * An answer is an object of the fields of worker/protocol.h, each of its kind; texts have a limit;
 * metrics are known by name (model/metrics.h, or counters of the simulated GPU), belong where they
 * stand, have their unit, and a value of their range; a frame has a metric once. Fields that are
 * not known are left alone. */
#ifndef FM_ANSWER_CHECK_H
#define FM_ANSWER_CHECK_H

#include <jansson.h>
#include <stdbool.h>
#include <stdint.h>

#include "base/error.h"

/* frames: how many an answer may speak of. FM_INVALID: what is wrong, in words that follow "the
 * worker's result cannot be used: "; FM_NO_MEMORY. */
fm_status answer_check(const json_t *answer, uint32_t frames, fm_error *err);

/* What is asked of a worker beside that, and not of journals, which older programs wrote: a case
 * that is not supported has a reason. After answer_check; FM_INVALID. */
fm_status answer_check_reason(const json_t *answer, fm_error *err);

/* A number of a case or launch: JSON has no words for what is no finite number, so such travel as
 * the texts "inf", "-inf" and "nan". false: it is none of these. */
bool answer_value(double *value, const json_t *json);

#endif
