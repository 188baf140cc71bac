/* The images of the timed frames. Each is hashed on the device. One that differs from those before,
 * of this launch and of earlier ones, is kept until the frames are over, and compared with truth.
 */
#include <math.h>
#include <stdlib.h>

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

fm_status frame_images_begin(frame_images *images, fm_measurement *measurement,
                             const fm_measure_desc *desc, fm_error *err)
{
    const fm_method_desc *method = desc->method->method;
    const uint64_t bytes = (uint64_t)desc->truth->width_px * desc->truth->height_px * 16;
    const uint64_t fit = KEPT_BYTES / bytes, most = fit < desc->frames ? fit : desc->frames;
    *images = (frame_images){ .desc = desc, .most = most > 1 ? (uint32_t)most : 1 };
    images->kept = calloc(images->most, sizeof *images->kept);
    if (images->kept == NULL)
        return fm_fail(err, FM_NO_MEMORY, "no memory for %u images", images->most);
    measurement->may_differ =
        (method->traits & FM_TRAIT_EXACT) != 0 &&
        truth_tied_pixels(desc->truth, measure_wanted(method, desc->method->settings->k)) > 0;
    return FM_OK;
}

static bool is_among(const uint64_t *hashes, size_t count, uint64_t hash)
{
    for (size_t i = 0; i < count; i++)
        if (hashes[i] == hash)
            return true;
    return false;
}

static bool is_known(const frame_images *images, uint64_t hash)
{
    return is_among(images->desc->known_images, images->desc->known_count, hash);
}

fm_status frame_images_expect(frame_images *images, fm_instance *method, fm_error *err)
{
    frame_image *expected = &images->expected;
    const fm_status status = instance_image_hash(&expected->hash, method, err);
    if (status != FM_OK || is_known(images, expected->hash))
        return status;
    return measure_read_image(&expected->image, images->desc->method->stage, err);
}

/* The errors of those that wait, and what they reach. */
static fm_status compare_kept(fm_measurement *measurement, const reference_images *kept,
                              double stops, fm_error *err)
{
    fm_status status = reference_worst(&measurement->frames_worst, kept, stops, err);
    for (size_t i = 0; i < kept->count && status == FM_OK; i++)
        status = image_range_add(&measurement->range, kept->images[i], err);
    measurement->has_new_images = true;
    return status;
}

static fm_status compare(frame_images *images, fm_measurement *measurement,
                         const reference_images *kept, fm_error *err)
{
    const fm_measure_desc *desc = images->desc;
    double apart = 0;
    fm_status status = FM_OK;
    if (measurement->may_differ)
        status = reference_distance(&apart, kept, err);
    measurement->frames_beyond = fmax(measurement->frames_beyond, apart);
    const bool is_left_to_check = desc->check && measurement->distinct_images == 1;
    if (status == FM_OK && !is_left_to_check)
        status = compare_kept(measurement, kept, desc->method->settings->exposure, err);
    return status;
}

static fm_status settle(frame_images *images, fm_measurement *measurement, fm_error *err)
{
    const fm_measure_desc *desc = images->desc;
    if (images->count == 0)
        return FM_OK;
    fm_image **pictures = calloc(images->count, sizeof *pictures);
    if (pictures == NULL)
        return fm_fail(err, FM_NO_MEMORY, "no memory for %u images", images->count);
    for (uint32_t i = 0; i < images->count; i++)
        pictures[i] = images->kept[i].image;
    const reference_images kept = { .truth = desc->truth,
                                    .wanted = measure_k(measurement, desc),
                                    .traits = desc->method->method->traits,
                                    .rounding = measure_rounding(desc),
                                    .images = pictures,
                                    .count = images->count };
    const fm_status status = compare(images, measurement, &kept, err);
    free(pictures);
    return status;
}

static void drop_kept(frame_images *images)
{
    for (uint32_t i = 0; i < images->count; i++)
        image_destroy(images->kept[i].image);
    images->count = 0;
}

fm_status frame_images_add(frame_images *images, fm_measurement *measurement, fm_instance *method,
                           fm_error *err)
{
    fm_status status = instance_image_hash(&images->last, method, err);
    if (status != FM_OK ||
        is_among(measurement->image_hashes, measurement->distinct_images, images->last))
        return status;
    measurement->image_hashes[measurement->distinct_images++] = images->last;
    if (is_known(images, images->last))
        return FM_OK;
    if (images->count == images->most) {
        status = settle(images, measurement, err);
        drop_kept(images);
    }
    frame_image *kept = &images->kept[images->count];
    *kept = (frame_image){ .hash = images->last };
    if (images->expected.image != NULL && images->expected.hash == images->last) {
        kept->image = images->expected.image;
        images->expected.image = NULL;
    } else if (status == FM_OK) {
        status = measure_read_image(&kept->image, images->desc->method->stage, err);
    }
    images->count += kept->image != NULL;
    return status;
}

fm_status frame_images_end(frame_images *images, fm_measurement *measurement, fm_error *err)
{
    fm_status status = settle(images, measurement, err);
    for (uint32_t i = 0; i < images->count && status == FM_OK; i++) {
        if (images->kept[i].hash != images->last)
            continue;
        measurement->image = images->kept[i].image;
        images->kept[i].image = NULL;
    }
    if (status == FM_OK && measurement->image == NULL)
        status = measure_read_image(&measurement->image, images->desc->method->stage, err);
    return status;
}

void frame_images_free(frame_images *images)
{
    drop_kept(images);
    free(images->kept);
    images->kept = NULL;
    image_destroy(images->expected.image);
    images->expected.image = NULL;
}
