#include "measure.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "plugin/culling_apply.h"

/* Of how many checked pixels the truth stays in memory. */
enum { FORGET_PIXELS = 4096 };
enum { SLOTS_SPARE = 4, LONG_FRAME_SAMPLES = 2, LOSSY_FRAMES = 16 };
/* Captured fragments of one band: below every device's bound range. */
#define BAND_BYTES (64ull << 20)

uint32_t measure_wanted(const fm_method_desc *method, uint32_t k)
{
    switch (method->keeps) {
    case FM_KEEPS_K_NEAREST:
        return k;
    case FM_KEEPS_NEAREST:
        return 1;
    case FM_KEEPS_ALL:
    case FM_KEEPS_ALL_IN_K:
    case FM_KEEPS_COUNT:
        break;
    }
    return UINT32_MAX;
}

uint32_t measure_places(const fm_method_desc *method, uint32_t k)
{
    const uint32_t wanted = method->keeps == FM_KEEPS_ALL_IN_K ? k : measure_wanted(method, k);
    return wanted == UINT32_MAX ? 0 : wanted;
}

/* A layer rounds the sum and what shows, each by half an ulp of 1 at most, 2^-25: at random they
 * walk to sqrt(2 n) 2^-25. Sequences of 128 to 2048 layers were seen to reach 2^-24 sqrt(n); twice
 * that is allowed, and for few layers what a picture is compared by. */
double measure_image_tolerance(uint32_t n)
{
    const double few_layers = 1e-6;
    return fmax(few_layers, 0x1p-23 * sqrt((double)n));
}

static uint64_t store_time(const fm_frame_result *frame, const fm_method_desc *method)
{
    uint64_t sum = 0;
    for (size_t i = 0; i < FM_MAX_PASSES && method->passes[i].name != NULL; i++)
        if (strcmp(method->passes[i].name, "store") == 0)
            sum += frame->pass_ns[i];
    return sum;
}

/* A frame in which a lock was given up is counted and run again. What is lost every time is the
 * method's own loss. */
static fm_status frame_again_if_lossy(fm_frame_result *result, fm_measurement *measurement,
                                      fm_instance *instance, const fm_band *band, fm_error *err)
{
    const int tries = instance_may_give_up(instance) ? LOSSY_FRAMES : 1;
    fm_status status = FM_OK;
    for (int i = 0; i < tries && status == FM_OK; i++) {
        status = instance_frame(result, instance, band, err);
        measurement->frames_redone += result->redos;
        measurement->redone_ns += result->redone_ns;
        if (status != FM_OK || result->lost == 0)
            break;
        measurement->frames_lossy++;
    }
    return status;
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
    fm_status status = frame_again_if_lossy(&result, measurement, pair->method, NULL, err);
    memcpy(sample->pass_ns, result.pass_ns, sizeof sample->pass_ns);
    sample->frame_ns = frame_passes_ns(&result);
    sample->wall_ns = result.wall_ns;
    sample->canary_ns = result.canary_ns;
    measurement->scene_passes = result.scene_passes;
    measurement->lost = result.lost > measurement->lost ? result.lost : measurement->lost;
    return status;
}

static fm_status sample_floor(fm_sample *sample, const launch_pair *pair, fm_error *err)
{
    fm_frame_result result;
    fm_status status = instance_frame(&result, pair->floor, NULL, err);
    sample->floor_frame_ns = frame_passes_ns(&result);
    sample->floor_store_ns = store_time(&result, pair->desc->floor->method);
    return status;
}

/* One frame of each, so that both see the same machine; by turns the one or the other is first. */
static fm_status sample_once(fm_sample *sample, fm_measurement *measurement,
                             const launch_pair *pair, bool floor_first, fm_error *err)
{
    fm_status status = floor_first ? sample_floor(sample, pair, err) : FM_OK;
    if (status == FM_OK)
        status = sample_method(sample, measurement, pair, err);
    if (status == FM_OK && !floor_first)
        status = sample_floor(sample, pair, err);
    return status;
}

static fm_status take_samples(fm_measurement *measurement, const launch_pair *pair, fm_error *err)
{
    const fm_measure_desc *desc = pair->desc;
    fm_sample ignored;
    fm_status status = FM_OK;
    bool is_long = false;
    for (uint32_t i = 0; i < desc->warmup && status == FM_OK && !is_long; i++) {
        status = sample_once(&ignored, measurement, pair, false, err);
        is_long = i > 0 && ignored.wall_ns > MEASURE_LONG_FRAME_NS;
    }
    measurement->lost = 0;
    for (uint32_t i = 0; i < desc->frames && status == FM_OK; i++) {
        fm_sample *sample = &measurement->samples[i];
        if (is_long && i >= LONG_FRAME_SAMPLES)
            break;
        status = sample_once(sample, measurement, pair, i % 2 == 1, err);
        is_long = is_long || sample->wall_ns > MEASURE_LONG_FRAME_NS;
        measurement->sample_count = i + 1;
    }
    measurement->is_long = is_long;
    return status;
}

/* The device keeps 1 - A in place of A. */
static fm_status read_image(fm_image **image, fm_stage *stage, fm_error *err)
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

static uint32_t wanted_of(const fm_measurement *measurement, const fm_measure_desc *desc)
{
    return measurement->k_chosen > 0
               ? measurement->k_chosen
               : measure_wanted(desc->method->method, desc->method->settings->k);
}

static void take_bytes(fm_measurement *measurement, const fm_instance *instance,
                       const fm_measure_desc *desc)
{
    const uint64_t kept = measurement->k_chosen > 0 ? truth_kept(desc->truth, measurement->k_chosen)
                                                    : desc->method->fragments_kept;
    measurement->bytes_predicted = instance_bytes_predicted(instance);
    measurement->bytes_used = instance_bytes_used(instance, kept);
}

/* The timed part; the method's memory is given back before the checked build asks for its own. The
 * floor's frame writes no image, so the method's stays in the output. */
static fm_status measure_times(fm_measurement *measurement, const fm_measure_desc *desc,
                               fm_error *err)
{
    fm_stage *stage = desc->method->stage;
    const fm_ledger *ledger = &stage->device->ledger;
    fm_instance *method = NULL, *floor = NULL;
    fm_status status = instance_create(&floor, desc->floor, err);
    if (status == FM_OK)
        status = instance_create(&method, desc->method, err);
    if (status == FM_OK)
        status = take_samples(measurement, &(launch_pair){ method, floor, desc }, err);
    if (status == FM_OK)
        status = read_image(&measurement->image, stage, err);
    if (status == FM_OK)
        status = take_k(measurement, method, desc->method, err);
    if (status == FM_OK)
        take_bytes(measurement, method, desc);
    /* What destroying it gives back: the floor may have grown beside it. */
    const uint64_t with_method = ledger->bytes[FM_OWNER_METHOD];
    instance_destroy(method);
    measurement->bytes_allocated = with_method - ledger->bytes[FM_OWNER_METHOD];
    instance_destroy(floor);
    return status;
}

/* ---- check ---- */

typedef struct checking {
    fm_measurement *measurement;
    const fm_truth *truth;
    fm_stage *stage;
    uint32_t wanted;
    uint32_t slots;
    uint32_t band_pixels;
    fm_fragment *fragments; /* [band_pixels][slots], as captured */
    uint32_t (*counts)[2];  /* [band_pixels]: from the front, from the back */
    fm_fragment *pixel;     /* [slots]: one pixel's, in order */
} checking;

/* Front ranks fill a pixel's slots from the start, back ranks from the end. */
static uint32_t gather(checking *check, uint32_t local)
{
    const fm_fragment *row = &check->fragments[(uint64_t)local * check->slots];
    const uint32_t front = check->counts[local][0], back = check->counts[local][1];
    if ((uint64_t)front + back > check->slots) { /* more than anybody could want */
        check->measurement->check.extra += (uint64_t)front + back - check->slots;
        memcpy(check->pixel, row, check->slots * sizeof *row);
        return check->slots;
    }
    memcpy(check->pixel, row, front * sizeof *row);
    memcpy(check->pixel + front, row + check->slots - back, back * sizeof *row);
    return front + back;
}

static void check_image(checking *check, uint64_t pixel, uint32_t count)
{
    double rgba[4];
    const float *timed = &check->measurement->image->rgba[4 * pixel];
    composite_pixel(rgba, check->pixel, count);
    for (int channel = 0; channel < 4; channel++) {
        const double apart = fabs(rgba[channel] - (double)timed[channel]);
        if (!(apart <= check->measurement->self_max_abs))
            check->measurement->self_max_abs = apart;
    }
}

/* Fragments of equal depth and different colour among the first `wanted`, or at their end: which
 * comes first, or at all, is open, and the timed frame may choose otherwise than the captured one.
 */
static bool has_open_tie(const fm_fragment *truth, uint32_t count, uint32_t wanted)
{
    for (uint32_t i = 1; i < count && i <= wanted; i++)
        if (truth[i].depth <= truth[i - 1].depth && truth[i].colour != truth[i - 1].colour)
            return true;
    return false;
}

static fm_status check_band(checking *check, const fm_band *band, fm_error *err)
{
    const fm_device_ops *ops = check->stage->device->ops;
    fm_slot *slots = check->stage->slots;
    fm_status status =
        ops->buffer_read(check->stage->device, slots[STAGE_CAPTURE].buffer, 0, check->fragments,
                         (uint64_t)band->pixels * check->slots * sizeof(fm_fragment), err);
    if (status == FM_OK)
        status = ops->buffer_read(check->stage->device, slots[STAGE_CAPTURE_COUNTS].buffer, 0,
                                  check->counts, (uint64_t)band->pixels * 8, err);
    for (uint32_t i = 0; i < band->pixels && status == FM_OK; i++) {
        const uint64_t pixel = (uint64_t)band->first + i;
        const uint64_t first = check->truth->offsets[pixel];
        const uint32_t all = (uint32_t)(check->truth->offsets[pixel + 1] - first);
        const uint32_t count = gather(check, i);
        const fm_fragment *truth = &check->truth->fragments[first];
        if (!has_open_tie(truth, all, check->wanted))
            check_image(check, pixel, count);
        check_pixel(&check->measurement->check, check->pixel, count, truth, all,
                    check->wanted < all ? check->wanted : all);
        if (i % FORGET_PIXELS == FORGET_PIXELS - 1 || i + 1 == band->pixels)
            truth_forget(check->truth, pixel - i % FORGET_PIXELS, pixel + 1);
    }
    return status;
}

static fm_status check_bands(checking *check, fm_instance *instance, fm_error *err)
{
    const uint64_t pixels = (uint64_t)check->truth->width_px * check->truth->height_px;
    fm_status status = FM_OK;
    for (uint64_t first = 0; first < pixels && status == FM_OK; first += check->band_pixels) {
        const uint64_t left = pixels - first;
        const fm_band band = { (uint32_t)first,
                               left < check->band_pixels ? (uint32_t)left : check->band_pixels };
        fm_frame_result result;
        if (first > 0 && instance_can_emit_again(instance)) {
            status = instance_emit(instance, &band, err);
        } else {
            status = frame_again_if_lossy(&result, check->measurement, instance, &band, err);
            if (result.lost > check->measurement->lost)
                check->measurement->lost = result.lost;
            check->measurement->culled = result.culled;
            check->measurement->locked = result.locked;
            check->measurement->arrived = result.arrived;
        }
        if (status == FM_OK)
            status = check_band(check, &band, err);
    }
    return status;
}

static fm_status create_checking(checking *check, const fm_measure_desc *desc, fm_error *err)
{
    const fm_truth *truth = desc->truth;
    const uint64_t pixels = (uint64_t)truth->width_px * truth->height_px;
    const uint32_t most = check->wanted < truth->n ? check->wanted : truth->n;
    check->slots = most + SLOTS_SPARE;
    const uint64_t fit = BAND_BYTES / (check->slots * sizeof(fm_fragment));
    check->band_pixels = (uint32_t)(fit < 1 ? 1 : fit > pixels ? pixels : fit);
    check->fragments = malloc((uint64_t)check->band_pixels * check->slots * sizeof(fm_fragment));
    check->counts = malloc(check->band_pixels * sizeof check->counts[0]);
    check->pixel = malloc(check->slots * sizeof check->pixel[0]);
    if (check->fragments == NULL || check->counts == NULL || check->pixel == NULL)
        return fm_fail(err, FM_NO_MEMORY, "checking %u fragments a pixel", check->slots);
    return stage_create_capture(check->stage, check->band_pixels, check->slots, err);
}

static fm_status check_fragments(fm_measurement *measurement, const fm_measure_desc *desc,
                                 fm_error *err)
{
    checking check = { .measurement = measurement,
                       .truth = desc->truth,
                       .stage = desc->method->stage,
                       .wanted = wanted_of(measurement, desc) };
    fm_instance_desc capture = *desc->method;
    fm_instance *instance = NULL;
    fm_status status = create_checking(&check, desc, err);
    capture.is_capture = true;
    capture.capture_slots = check.slots;
    if (status == FM_OK)
        status = instance_create(&instance, &capture, err);
    if (status == FM_OK)
        status = check_bands(&check, instance, err);
    if (status == FM_OK && culling_is_applied(desc->method->method)) {
        instance_tell_fragments(instance, measurement->arrived); /* pools are sized by these */
        take_bytes(measurement, instance, desc);
    }
    measurement->is_checked = status == FM_OK;
    instance_destroy(instance);
    free(check.fragments);
    free(check.counts);
    free(check.pixel);
    return status;
}

static fm_status check_images(fm_measurement *measurement, const fm_measure_desc *desc,
                              fm_error *err)
{
    const uint32_t wanted = wanted_of(measurement, desc);
    fm_image *all = NULL;
    fm_image_error apart;
    fm_status status = truth_composite(&measurement->truth_image, desc->truth,
                                       wanted == UINT32_MAX ? 0 : wanted, err);
    if (status == FM_OK)
        status = truth_composite(&all, desc->truth, 0, err);
    if (status == FM_OK)
        status =
            image_compare(&measurement->error, measurement->image, measurement->truth_image, err);
    if (status == FM_OK)
        status = image_compare(&apart, measurement->truth_image, all, err);
    measurement->truncation_rmse = status == FM_OK ? apart.rmse : NAN;
    if (status == FM_OK)
        status = image_compare(&apart, measurement->image, all, err);
    measurement->total_rmse = status == FM_OK ? apart.rmse : NAN;
    image_destroy(all);
    return status;
}

fm_status measure_case(fm_measurement *measurement, const fm_measure_desc *desc, fm_error *err)
{
    *measurement = (fm_measurement){ 0 };
    measurement->samples = calloc(desc->frames, sizeof measurement->samples[0]);
    if (measurement->samples == NULL)
        return fm_fail(err, FM_NO_MEMORY, "%u samples", desc->frames);
    fm_status status = measure_times(measurement, desc, err);
    if (status == FM_OK && desc->check)
        status = check_fragments(measurement, desc, err);
    if (status == FM_OK && desc->check)
        status = check_images(measurement, desc, err);
    return status;
}

void measurement_free(fm_measurement *measurement)
{
    free(measurement->samples);
    image_destroy(measurement->image);
    image_destroy(measurement->truth_image);
    *measurement = (fm_measurement){ 0 };
}
