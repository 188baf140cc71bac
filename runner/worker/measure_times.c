#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "base/clock.h"
#include "measure_internal.h"

enum { LONG_FRAME_SAMPLES = 2, LOSSY_FRAMES = 16 };

static uint64_t store_time(const fm_frame_result *frame, const fm_method_desc *method)
{
    uint64_t sum = 0;
    for (size_t i = 0; i < FM_MAX_PASSES && method->passes[i].name != NULL; i++)
        if (strcmp(method->passes[i].name, "store") == 0)
            sum += frame->pass_ns[i];
    return sum;
}

fm_status measure_frame(fm_frame_result *result, fm_measurement *measurement, fm_instance *instance,
                        const fm_band *band, fm_error *err)
{
    const int tries = instance_may_give_up(instance) ? LOSSY_FRAMES : 1;
    fm_status status = FM_OK;
    for (int i = 0; i < tries && status == FM_OK; i++) {
        status = instance_frame(result, instance, band, err);
        measurement->frames_redone += result->redos;
        measurement->redone_ns += result->redone_ns;
        if (status != FM_OK || (result->lost == 0 && result->cut == 0))
            break;
        measurement->frames_lossy++;
        measurement->gave_up = measurement->gave_up || (tries > 1 && i == tries - 1);
    }
    return status == FM_OK ? instance_cut(instance, result->cut, err) : status;
}

/* The method and the floor of one launch. */
typedef struct launch_pair {
    fm_instance *method, *floor;
    const fm_measure_desc *desc;
} launch_pair;

static fm_status sample_method(fm_sample *sample, fm_measurement *measurement,
                               const launch_pair *pair, fm_error *err)
{
    fm_frame_result result;
    const uint64_t cpu_ns = clock_process_ns();
    fm_status status = measure_frame(&result, measurement, pair->method, NULL, err);
    sample->cpu_ns = clock_process_ns() - cpu_ns;
    memcpy(sample->pass_ns, result.pass_ns, sizeof sample->pass_ns);
    sample->frame_ns = frame_passes_ns(&result);
    sample->wall_ns = result.wall_ns;
    sample->canary_ns = result.canary_ns;
    measurement->scene_passes = result.scene_passes;
    measurement->lost = result.lost > measurement->lost ? result.lost : measurement->lost;
    return status;
}

static fm_status sample_floor(fm_sample *sample, fm_measurement *measurement,
                              const launch_pair *pair, fm_error *err)
{
    fm_frame_result result;
    const launch_part before = parts_enter(pair->desc->parts, PART_FLOOR);
    fm_status status = instance_frame(&result, pair->floor, NULL, err);
    parts_enter(pair->desc->parts, before);
    measurement->is_floors = status != FM_OK;
    sample->floor_frame_ns = frame_passes_ns(&result);
    sample->floor_store_ns = store_time(&result, pair->desc->floor->method);
    return status;
}

/* One frame of each, so that both see the same machine; by turns the one or the other is first. */
static fm_status sample_once(fm_sample *sample, fm_measurement *measurement,
                             const launch_pair *pair, bool floor_first, fm_error *err)
{
    fm_status status = floor_first ? sample_floor(sample, measurement, pair, err) : FM_OK;
    if (status == FM_OK)
        status = sample_method(sample, measurement, pair, err);
    if (status == FM_OK && !floor_first)
        status = sample_floor(sample, measurement, pair, err);
    return status;
}

/* A k that the method chose is judged before anything is compared with it. */
static fm_status take_k(fm_measurement *measurement, const fm_instance *instance,
                        const fm_instance_desc *desc, fm_error *err)
{
    const uint64_t k = instance_k_chosen(instance);
    if (desc->method->k_total == NULL)
        return FM_OK;
    if (k == 0 || k > desc->settings->k)
        return fm_fail(err, FM_INVALID, "%s: total '%s' chose k = %" PRIu64 ", not 1 to %u",
                       desc->method->id, desc->method->k_total, k, desc->settings->k);
    measurement->k_chosen = (uint32_t)k;
    return FM_OK;
}

static fm_status take_samples(fm_measurement *measurement, const launch_pair *pair, fm_error *err)
{
    const fm_measure_desc *desc = pair->desc;
    frame_images images;
    fm_sample ignored;
    bool is_long = false;
    parts_enter(desc->parts, PART_IMAGES);
    fm_status status = frame_images_begin(&images, measurement, desc, err);
    parts_enter(desc->parts, PART_WARMUP);
    for (uint32_t i = 0; i < desc->warmup && status == FM_OK && !is_long; i++) {
        status = sample_once(&ignored, measurement, pair, false, err);
        is_long = i > 0 && ignored.wall_ns > MEASURE_LONG_FRAME_NS;
    }
    parts_enter(desc->parts, PART_IMAGES);
    if (status == FM_OK && desc->warmup > 0)
        status = frame_images_expect(&images, pair->method, err);
    measurement->lost = 0;
    host_load_read(&measurement->begin, "");
    for (uint32_t i = 0; i < desc->frames && status == FM_OK; i++) {
        fm_sample *sample = &measurement->samples[i];
        if (is_long && i >= LONG_FRAME_SAMPLES)
            break;
        parts_enter(desc->parts, PART_FRAMES);
        status = sample_once(sample, measurement, pair, i % 2 == 1, err);
        parts_enter(desc->parts, PART_IMAGES);
        is_long = is_long || sample->wall_ns > MEASURE_LONG_FRAME_NS;
        measurement->sample_count = i + 1;
        if (status == FM_OK)
            status = take_k(measurement, pair->method, desc->method, err);
        if (status == FM_OK)
            status = frame_images_add(&images, measurement, pair->method, err);
    }
    host_load_read(&measurement->end, "");
    if (status == FM_OK)
        status = frame_images_end(&images, measurement, err);
    frame_images_free(&images);
    measurement->is_long = is_long;
    return status;
}

void measure_bytes(fm_measurement *measurement, const fm_instance *instance,
                   const fm_measure_desc *desc)
{
    const uint64_t kept = measurement->k_chosen > 0 ? truth_kept(desc->truth, measurement->k_chosen)
                                                    : desc->method->fragments_kept;
    measurement->bytes_predicted = instance_bytes_predicted(instance);
    measurement->bytes_used = instance_bytes_used(instance, kept);
}

fm_status measure_times(fm_measurement *measurement, const fm_measure_desc *desc, fm_error *err)
{
    fm_stage *stage = desc->method->stage;
    const fm_ledger *ledger = &stage->device->ledger;
    fm_instance *method = NULL, *floor = NULL;
    fm_instance_desc timed = *desc->method;
    timed.hashes_image = true;
    parts_enter(desc->parts, PART_COMPILE);
    fm_status status = instance_create(&floor, desc->floor, err);
    measurement->is_floors = status != FM_OK;
    if (status == FM_OK)
        status = instance_create(&method, &timed, err);
    if (status == FM_OK)
        status = take_samples(measurement, &(launch_pair){ method, floor, desc }, err);
    if (status == FM_OK)
        measure_bytes(measurement, method, desc);
    /* What destroying it gives back: the floor may have grown beside it. */
    const uint64_t with_method = ledger->bytes[FM_OWNER_METHOD];
    instance_destroy(method);
    measurement->bytes_allocated = with_method - ledger->bytes[FM_OWNER_METHOD];
    instance_destroy(floor);
    return status;
}
