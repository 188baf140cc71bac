/* What a worker's answer says of a measurement: metrics, samples, image hash, what was modelled.
 * The fields are protocol.h's. */
#ifndef FM_ANSWER_H
#define FM_ANSWER_H

#include <jansson.h>

#include "measure.h"
#include "model/metrics.h"

/* All borrowed. */
typedef struct fm_answer_desc {
    const fm_measurement *measurement;
    const fm_method_desc *method; /* as it was run */
    const fm_settings *settings;
    const fm_truth *truth;
    const fm_stage *stage;
} fm_answer_desc;

/* One number of a case: metrics is the answer's object of that name. What is not finite travels as
 * a text, for JSON has no such numbers. */
void answer_set_number(json_t *metrics, fm_metric metric, double value);
void answer_set_count(json_t *metrics, fm_metric metric, uint64_t value);
/* One number of a frame: samples is the answer's list of that name. */
void answer_add_sample(json_t *samples, uint32_t frame, fm_metric metric, double value);

void answer_add_measured(json_t *answer, const fm_answer_desc *desc);
/* How busy the host was during this launch, as far as the system tells, and how wrong the images
 * were that it was the first to draw; and where its time went until now. m: its sample_count is 0
 * where no frames were timed. */
void answer_add_launch(json_t *answer, const fm_measurement *m, launch_parts *parts);
void answer_add_truth(json_t *answer, const fm_truth *truth);

#endif
