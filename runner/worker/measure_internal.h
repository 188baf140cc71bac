/* Shared by the files of measure.h: measure.c, measure_times.c (times), measure_images.c (their
 * images) and measure_check.c (fragments and pictures). */
#ifndef FM_MEASURE_INTERNAL_H
#define FM_MEASURE_INTERNAL_H

#include "measure.h"
#include "truth/rounding.h"

/* One frame. A frame in which a lock was given up is counted and run again. What is lost every time
 * is the method's own loss. */
fm_status measure_frame(fm_frame_result *result, fm_measurement *measurement, fm_instance *instance,
                        const fm_band *band, fm_error *err);
/* Fragments of a pixel that truth wants in this frame: the k that the method chose, or
 * measure_wanted. */
uint32_t measure_k(const fm_measurement *measurement, const fm_measure_desc *desc);
/* The case's keys `accumulate` and `composite`. */
fm_rounding measure_rounding(const fm_measure_desc *desc);
/* Takes bytes_predicted and bytes_used from the instance. */
void measure_bytes(fm_measurement *measurement, const fm_instance *instance,
                   const fm_measure_desc *desc);

/* An image and its hash. */
typedef struct frame_image {
    fm_image *image; /* NULL: none */
    uint64_t hash;
} frame_image;

/* Images of timed frames that wait for their comparison with truth. */
typedef struct frame_images {
    const fm_measure_desc *desc;
    frame_image *kept;    /* [count]; owned */
    uint32_t count, most; /* most: all frames', or as many as memory is given for */
    frame_image expected; /* what the last warm-up frame drew: where timed frames draw the same,
                             nothing has to be read between them */
    uint64_t last;        /* hash of the last timed frame's image */
} frame_images;

/* FM_NO_MEMORY. frame_images_free also after a failure. */
fm_status frame_images_begin(frame_images *images, fm_measurement *measurement,
                             const fm_measure_desc *desc, fm_error *err);
/* Takes the image of the warm-up frame that just ended. */
fm_status frame_images_expect(frame_images *images, fm_instance *method, fm_error *err);
/* Hashes the image of the frame that just ended, and keeps it if it is new. Only where there is no
 * room for it are those that wait compared first, which disturbs the next frame: a walk over all of
 * truth. */
fm_status frame_images_add(frame_images *images, fm_measurement *measurement, fm_instance *method,
                           fm_error *err);
/* After the last frame: compares those that wait with truth, and fills the measurement's image. A
 * checked launch whose frames all drew one image leaves the comparison to the check. */
fm_status frame_images_end(frame_images *images, fm_measurement *measurement, fm_error *err);
void frame_images_free(frame_images *images);
/* The image of the last frame; the device keeps 1 - A in place of A. */
fm_status measure_read_image(fm_image **image, fm_stage *stage, fm_error *err);

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
