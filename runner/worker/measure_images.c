/* The images of the timed frames. Each is hashed on the device. Where ties allow several, each that
 * differs from those before is kept until the frames are over, and compared with truth. */
#include <math.h>

#include "measure_internal.h"
#include "truth/reference.h"

/* Of the images that wait. */
#define KEPT_BYTES (256ull << 20)

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
    if (status != FM_OK) {
        image_destroy(*image);
        *image = NULL;
    }
    return status;
}

void frame_images_begin(frame_images *images, fm_measurement *measurement,
                        const fm_measure_desc *desc)
{
    const fm_method_desc *method = desc->method->method;
    const uint64_t bytes = (uint64_t)desc->truth->width_px * desc->truth->height_px * 16;
    const uint64_t fit = KEPT_BYTES / bytes;
    *images = (frame_images){ .desc = desc };
    images->most = fit > FRAME_IMAGES_KEPT ? FRAME_IMAGES_KEPT : fit > 1 ? (uint32_t)fit : 1;
    measurement->may_differ =
        (method->traits & FM_TRAIT_EXACT) != 0 &&
        truth_tied_pixels(desc->truth, measure_wanted(method, desc->method->settings->k)) > 0;
}

fm_status frame_images_settle(frame_images *images, fm_measurement *measurement, fm_error *err)
{
    const fm_measure_desc *desc = images->desc;
    const reference_images kept = { .truth = desc->truth,
                                    .wanted = measure_k(measurement, desc),
                                    .traits = desc->method->method->traits,
                                    .rounding = measure_rounding(desc),
                                    .images = images->kept,
                                    .count = images->count };
    double apart = 0;
    const fm_status status = images->count > 0 ? reference_distance(&apart, &kept, err) : FM_OK;
    measurement->frames_max_abs = fmax(measurement->frames_max_abs, apart);
    frame_images_free(images);
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
    uint64_t hash;
    fm_status status = instance_image_hash(&hash, method, err);
    if (status != FM_OK || is_known(measurement, hash))
        return status;
    measurement->image_hashes[measurement->distinct_images++] = hash;
    if (!measurement->may_differ)
        return FM_OK;
    if (images->count == images->most)
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
