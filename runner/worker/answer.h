/* What a worker's answer says of a measurement: metrics, samples, image hash, what was modelled.
 * The names are in worker.h. */
#ifndef FM_ANSWER_H
#define FM_ANSWER_H

#include <jansson.h>

#include "measure.h"

/* All borrowed. */
typedef struct fm_answer_desc {
    const fm_measurement *measurement;
    const fm_method_desc *method; /* as it was run */
    const fm_settings *settings;
    const fm_truth *truth;
    const fm_stage *stage;
} fm_answer_desc;

void answer_add_measured(json_t *result, const fm_answer_desc *of);
void answer_add_truth(json_t *result, const fm_truth *truth);

#endif
