/* Shared by measure.c (times) and measure_check.c (fragments and pictures); nobody else includes
 * it.
 */
#ifndef FM_MEASURE_INTERNAL_H
#define FM_MEASURE_INTERNAL_H

#include "measure.h"

/* One frame. A frame in which a lock was given up is counted and run again. What is lost every time
 * is the method's own loss. */
fm_status measure_frame(fm_frame_result *result, fm_measurement *measurement, fm_instance *instance,
                        const fm_band *band, fm_error *err);
/* Fragments of a pixel that truth wants in this frame: the k that the method chose, or
 * measure_wanted. */
uint32_t measure_k(const fm_measurement *measurement, const fm_measure_desc *desc);
/* Takes bytes_predicted and bytes_used from the instance. */
void measure_bytes(fm_measurement *measurement, const fm_instance *instance,
                   const fm_measure_desc *desc);

/* The timed part. The method's memory is given back before the checked build asks for its own. The
 * floor's frame writes no image, so the method's stays in the output. */
fm_status measure_times(fm_measurement *measurement, const fm_measure_desc *desc, fm_error *err);

/* Captures every emitted fragment in bands of pixels and compares it with truth. */
fm_status measure_check_fragments(fm_measurement *measurement, const fm_measure_desc *desc,
                                  fm_error *err);
/* Compares the timed image with the pictures of the wanted and of all fragments. */
fm_status measure_check_images(fm_measurement *measurement, const fm_measure_desc *desc,
                               fm_error *err);

#endif
