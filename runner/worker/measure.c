#include "measure_internal.h"

#include <stdlib.h>

#include "truth/reference.h"

fm_status measure_case(fm_measurement *measurement, const fm_measure_desc *desc, fm_error *err)
{
    *measurement = (fm_measurement){ 0 };
    measurement->samples = calloc(desc->frames, sizeof measurement->samples[0]);
    measurement->image_hashes = calloc(desc->frames, sizeof measurement->image_hashes[0]);
    if (measurement->samples == NULL || measurement->image_hashes == NULL)
        return fm_fail(err, FM_NO_MEMORY, "%u samples", desc->frames);
    fm_status status = measure_times(measurement, desc, err);
    if (status == FM_OK && desc->check)
        status = measure_check_fragments(measurement, desc, err);
    parts_enter(desc->parts, PART_ERRORS);
    if (status == FM_OK && desc->check)
        status = measure_check_images(measurement, desc, err);
    if (measurement->range.low != NULL) {
        reference_expose_image(measurement->range.low, desc->method->settings->exposure);
        reference_expose_image(measurement->range.high, desc->method->settings->exposure);
    }
    return status;
}

fm_accesses measure_accesses(const fm_measurement *measurement)
{
    fm_accesses sum = { 0 };
    for (size_t i = 0; i < measurement->accesses_count; i++) {
        const fm_accesses *counts = &measurement->accesses[i].counts;
        sum.loaded += counts->loaded;
        sum.stored += counts->stored;
        sum.atomics += counts->atomics;
        sum.outside += counts->outside;
    }
    return sum;
}

void measurement_free(fm_measurement *measurement)
{
    free(measurement->samples);
    free(measurement->image_hashes);
    free(measurement->accesses);
    image_destroy(measurement->image);
    image_destroy(measurement->truth_image);
    image_range_free(&measurement->range);
    *measurement = (fm_measurement){ 0 };
}
