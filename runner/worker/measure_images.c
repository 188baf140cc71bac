/* The images of the timed frames. Each is hashed on the device. Where ties allow several, each that
 * differs from those before is kept until the frames are over, and compared with truth. */
#include <math.h>

#include "measure_internal.h"
#include "truth/reference.h"

enum { LOSSES = FM_TRAIT_LOSES_DEPTH_ONE | FM_TRAIT_LOSES_TIES };

fm_status measure_read_image(fm_image **image, fm_stage *stage, fm_error *err)
{
    const fm_scene *scene = stage->scene;
    const uint64_t pixels = (uint64_t)scene->width_px * scene->height_px;
    fm_status status = image_create(image, scene->width_px, scene->height_px, err);
    if (status == FM_OK)
        status = stage->device->ops->buffer_read(stage->device, stage->slots[STAGE_OUTPUT].buffer,
                                                 0, (*image)->rgba, pixels * 16, err);
    for (uint64_t i = 0; i < pixels && status == FM_OK; i++)
        (*image)->rgba[4 * i + 3] = 1.0f - (*image)->rgba[4 * i + 3];
    return status;
}

void frame_images_begin(frame_images *images, fm_measurement *measurement,
                        const fm_measure_desc *desc)
{
    const uint32_t traits = desc->method->method->traits;
    const bool is_exact = (traits & FM_TRAIT_EXACT) != 0;
    measurement->may_differ = is_exact && truth_tied_pixels(desc->truth, UINT32_MAX) > 0;
    /* With a declared loss an image is not what truth has, and yet not wrong. */
    *images = (frame_images){ .desc = desc,
                              .are_compared = measurement->may_differ && (traits & LOSSES) == 0 };
}

fm_status frame_images_settle(frame_images *images, fm_measurement *measurement, fm_error *err)
{
    fm_status status = FM_OK;
    for (uint32_t i = 0; i < images->count; i++) {
        double apart = 0;
        if (status == FM_OK)
            status = reference_distance(&apart, images->desc->truth,
                                        measure_k(measurement, images->desc), images->kept[i], err);
        measurement->frames_max_abs = fmax(measurement->frames_max_abs, apart);
        image_destroy(images->kept[i]);
    }
    images->count = 0;
    return status;
}

static bool is_known(const fm_measurement *measurement, uint64_t hash)
{
    for (uint32_t i = 0; i < measurement->distinct_images; i++)
        if (measurement->image_hashes[i] == hash)
            return true;
    return false;
}

fm_status frame_images_add(frame_images *images, fm_measurement *measurement, fm_instance *method,
                           fm_error *err)
{
    fm_status status = instance_image_hash(&measurement->image_hash, method, err);
    if (status != FM_OK || is_known(measurement, measurement->image_hash))
        return status;
    measurement->image_hashes[measurement->distinct_images++] = measurement->image_hash;
    if (!images->are_compared)
        return FM_OK;
    if (images->count == FRAME_IMAGES_KEPT)
        status = frame_images_settle(images, measurement, err);
    if (status == FM_OK)
        status = measure_read_image(&images->kept[images->count], images->desc->method->stage, err);
    if (status == FM_OK)
        images->count++;
    return status;
}

void frame_images_free(frame_images *images)
{
    for (uint32_t i = 0; i < images->count; i++)
        image_destroy(images->kept[i]);
    images->count = 0;
}
