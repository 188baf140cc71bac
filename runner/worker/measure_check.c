/* The check of a launch: every fragment that the method hands over, and the picture. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <xxhash.h>

#include "measure_internal.h"
#include "plugin/culling_apply.h"
#include "truth/kept_file.h"
#include "truth/reference.h"

enum {
    FORGET_PIXELS = 4096, /* of how many checked pixels the truth stays in memory */
    SLOTS_SPARE = 4 /* places beyond the wanted fragments, for those that should not be there */
};
/* Captured fragments of one band: below every device's bound range. */
#define BAND_BYTES (64ull << 20)

typedef struct checking {
    fm_measurement *measurement;
    fm_check sums;                     /* of the running capture */
    uint64_t hashes[MEASURE_CAPTURES]; /* of the fragments of each capture so far */
    uint32_t capture;                  /* number of the running one */
    bool is_repeated;                  /* there may be several: fragments may differ */
    const fm_truth *truth;
    fm_stage *stage;
    uint32_t wanted;
    uint32_t slots;
    uint32_t band_pixels;
    fm_fragment *fragments; /* [band_pixels][slots], as captured */
    uint32_t (*counts)[2];  /* [band_pixels]: from the front, from the back */
    fm_fragment *pixel;     /* [slots]: one pixel's, in order */
    fm_rounding rounding;
    fm_ties *ties;
    kept_writer *kept; /* NULL: fragments are not kept */
} checking;

/* Front ranks fill a pixel's slots from the start, back ranks from the end. */
static uint32_t gather(checking *check, uint32_t local)
{
    const fm_fragment *row = &check->fragments[(uint64_t)local * check->slots];
    const uint32_t front = check->counts[local][0], back = check->counts[local][1];
    if ((uint64_t)front + back > check->slots) { /* more than anybody could want */
        check->sums.extra += (uint64_t)front + back - check->slots;
        memcpy(check->pixel, row, check->slots * sizeof *row);
        return check->slots;
    }
    memcpy(check->pixel, row, front * sizeof *row);
    memcpy(check->pixel + front, row + check->slots - back, back * sizeof *row);
    return front + back;
}

static uint64_t handed_over(const checking *check, uint32_t local)
{
    return (uint64_t)check->counts[local][0] + check->counts[local][1];
}

/* Before the check sorts them. */
static void keep_one(const checking *check, uint32_t local, uint32_t count)
{
    const uint64_t more = handed_over(check, local) - count;
    const uint32_t word = more < UINT32_MAX ? (uint32_t)more : UINT32_MAX;
    if (check->kept == NULL)
        return;
    kept_add_list(check->kept, check->pixel, count);
    kept_add_words(check->kept, &word, 1);
}

/* bound: what the case may round at this pixel. */
static void check_image(checking *check, uint64_t pixel, const fm_range *range, double bound)
{
    fm_measurement *m = check->measurement;
    const float *rgba = &m->image->rgba[4 * pixel];
    const double apart = range_distance(range, rgba);
    m->self_max_abs = fmax(apart, m->self_max_abs);
    if (apart - bound > m->self_beyond) {
        m->self_beyond = apart - bound;
        m->self_bound = bound;
    }
    m->image_ulp_max =
        fmax(rounding_ulps_apart(check->rounding.accumulate, range->low, range->high, rgba),
             m->image_ulp_max);
}

/* The pixels of a capture, whatever their order. */
static void add_hash(checking *check, uint64_t pixel, uint32_t local, uint32_t count)
{
    const uint64_t seed = pixel << 32 ^ handed_over(check, local);
    check->hashes[check->capture] +=
        XXH3_64bits_withSeed(check->pixel, count * sizeof check->pixel[0], seed);
}

/* A pixel's fragments in truth. */
typedef struct true_pixel {
    const fm_fragment *fragments;
    uint32_t count, wanted;
} true_pixel;

static true_pixel true_pixel_of(const checking *check, uint64_t pixel)
{
    const uint64_t first = check->truth->offsets[pixel];
    const uint32_t count = (uint32_t)(check->truth->offsets[pixel + 1] - first);
    return (true_pixel){ .fragments = &check->truth->fragments[first],
                         .count = count,
                         .wanted = check->wanted < count ? check->wanted : count };
}

/* Sorts them. */
static void check_fragments(checking *check, uint64_t pixel, uint32_t local, uint32_t count)
{
    const true_pixel truth = true_pixel_of(check, pixel);
    check_pixel(&check->sums, check->pixel, count, truth.fragments, truth.count, truth.wanted);
    if (check->is_repeated)
        add_hash(check, pixel, local, count);
}

/* All of a pixel in the first capture: what was captured, and what the timed frame drew there.
 * Where ties leave the order open the timed frame may choose otherwise than the captured one: any
 * picture will do that truth allows or, of a wrong pixel, that its own fragments do. */
static void check_first(checking *check, uint64_t pixel, uint32_t local, uint32_t count)
{
    const uint64_t wrong_before = check->sums.wrong_pixels;
    const true_pixel truth = true_pixel_of(check, pixel);
    const bool is_open = ties_are_open(truth.fragments, truth.count, truth.wanted);
    double bound = rounding_bound(check->rounding, check->pixel, count, count);
    fm_range range;
    keep_one(check, local, count);
    composite_pixel(range.low, check->pixel, count);
    memcpy(range.high, range.low, sizeof range.high);
    check_fragments(check, pixel, local, count);
    if (is_open && check->sums.wrong_pixels == wrong_before) {
        ties_range(&range, check->ties, truth.fragments, truth.count, truth.wanted);
        bound = rounding_bound(check->rounding, truth.fragments, truth.count, truth.wanted);
    } else if (is_open) {
        ties_range(&range, check->ties, check->pixel, count, count);
    }
    check_image(check, pixel, &range, bound);
    check->measurement->tied_pixels += is_open;
}

static void check_one(checking *check, uint64_t pixel, uint32_t local)
{
    const uint32_t count = gather(check, local);
    if (check->capture == 0)
        check_first(check, pixel, local, count);
    else
        check_fragments(check, pixel, local, count);
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
        check_one(check, pixel, i);
        if (i % FORGET_PIXELS == FORGET_PIXELS - 1 || i + 1 == band->pixels)
            truth_forget(check->truth, pixel - i % FORGET_PIXELS, pixel + 1);
    }
    return status;
}

static void note_counts(checking *check, const fm_frame_result *result)
{
    fm_measurement *m = check->measurement;
    m->lost = result->lost > m->lost ? result->lost : m->lost;
    if (check->capture > 0)
        return;
    m->culled = result->culled;
    m->locked = result->locked;
    m->arrived = result->arrived;
    m->repaired = result->repaired;
    m->unrepaired = result->unrepaired;
}

/* Of the first frame that is captured. */
static fm_status note_accesses(checking *check, const fm_instance *instance, fm_error *err)
{
    fm_measurement *m = check->measurement;
    fm_accesses counts;
    const char *name;
    if (m->accesses != NULL)
        return FM_OK;
    snprintf(m->uncounted, sizeof m->uncounted, "%s", instance_uncounted(instance));
    m->accesses = calloc(FM_MAX_RESOURCES + 1, sizeof m->accesses[0]);
    if (m->accesses == NULL)
        return fm_fail(err, FM_NO_MEMORY, "accesses of %d resources", FM_MAX_RESOURCES);
    while (instance_accesses(&counts, &name, instance, m->accesses_count)) {
        fm_resource_accesses *resource = &m->accesses[m->accesses_count++];
        snprintf(resource->name, sizeof resource->name, "%s", name);
        resource->counts = counts;
    }
    return FM_OK;
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
            status = measure_frame(&result, check->measurement, instance, &band, err);
            note_counts(check, &result);
            if (status == FM_OK)
                status = note_accesses(check, instance, err);
        }
        if (status == FM_OK)
            status = check_band(check, &band, err);
    }
    return status;
}

/* What one capture found. */
static void note_capture(checking *check)
{
    fm_measurement *m = check->measurement;
    bool is_new = true;
    for (uint32_t i = 0; i < check->capture; i++)
        is_new = is_new && check->hashes[i] != check->hashes[check->capture];
    m->distinct_fragments += is_new;
    m->captured_frames++;
    if (check->capture == 0)
        m->check = m->worst_check = check->sums;
    if (check_faults(&check->sums) > check_faults(&m->worst_check))
        m->worst_check = check->sums;
    m->missing_max = check->sums.missing > m->missing_max ? check->sums.missing : m->missing_max;
}

/* Who hands no fragments over, as an approximation, has none that could differ. */
static uint32_t captures_wanted(const checking *check)
{
    return check->is_repeated && check->measurement->check.captured > 0 ? MEASURE_CAPTURES : 1;
}

static fm_status check_captures(checking *check, fm_instance *instance, uint32_t traits,
                                fm_error *err)
{
    fm_status status;
    check->is_repeated = (traits & FM_TRAIT_RACY) != 0 || check->measurement->distinct_images > 1;
    do {
        check->sums = (fm_check){ .traits = traits };
        status = check_bands(check, instance, err);
        if (status == FM_OK)
            note_capture(check);
        check->capture++;
    } while (status == FM_OK && check->capture < captures_wanted(check));
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
    const fm_status status =
        ties_create(&check->ties, truth->n > check->slots ? truth->n : check->slots, err);
    if (status != FM_OK)
        return status;
    return stage_create_capture(check->stage, check->band_pixels, check->slots, err);
}

/* No plugin is to blame for a file of the run. */
static fm_status own(fm_status status, fm_error *err)
{
    if (status == FM_IO && err != NULL)
        err->is_own = true;
    return status;
}

static fm_status begin_keeping(checking *check, kept_writer *kept, const char *path, fm_error *err)
{
    const kept_header header = { .kind = KEPT_FRAGMENTS,
                                 .width_px = check->truth->width_px,
                                 .height_px = check->truth->height_px,
                                 .wanted = check->wanted,
                                 .list_count =
                                     (uint64_t)check->truth->width_px * check->truth->height_px };
    if (path == NULL || path[0] == '\0')
        return FM_OK;
    check->kept = kept;
    return own(kept_begin(kept, path, &header, err), err);
}

fm_status measure_check_fragments(fm_measurement *measurement, const fm_measure_desc *desc,
                                  fm_error *err)
{
    checking check = { .measurement = measurement,
                       .truth = desc->truth,
                       .stage = desc->method->stage,
                       .wanted = measure_k(measurement, desc),
                       .rounding = measure_rounding(desc) };
    fm_instance_desc capture = *desc->method;
    fm_instance *instance = NULL;
    kept_writer kept = { .out = NULL };
    fm_status status = create_checking(&check, desc, err);
    capture.is_capture = true;
    capture.capture_slots = check.slots;
    capture.counts_accesses = true;
    parts_enter(desc->parts, PART_COMPILE);
    if (status == FM_OK)
        status = instance_create(&instance, &capture, err);
    parts_enter(desc->parts, PART_CHECK);
    if (status == FM_OK)
        status = begin_keeping(&check, &kept, desc->keep, err);
    if (status == FM_OK)
        status = check_captures(&check, instance, desc->method->method->traits, err);
    if (status == FM_OK)
        status = own(kept_finish(&kept, FM_OK, err), err);
    else
        kept_finish(&kept, status, err);
    if (status == FM_OK && culling_is_applied(desc->method->method)) {
        instance_tell_fragments(instance, measurement->arrived); /* pools are sized by these */
        measure_bytes(measurement, instance, desc);
    }
    measurement->is_checked = status == FM_OK;
    instance_destroy(instance);
    free(check.fragments);
    free(check.counts);
    free(check.pixel);
    ties_destroy(check.ties);
    return status;
}

/* Which pixels have a fragment. */
static bool *covered_pixels(const fm_truth *truth)
{
    const uint64_t pixels = (uint64_t)truth->width_px * truth->height_px;
    bool *covered = malloc(pixels * sizeof *covered);
    for (uint64_t i = 0; covered != NULL && i < pixels; i++)
        covered[i] = truth->offsets[i + 1] > truth->offsets[i];
    return covered;
}

/* The picture of the wanted fragments, and that of all: of most exact methods they are one. */
static fm_status compare_both(fm_measurement *measurement, const fm_reference *reference,
                              const bool *covered, bool is_hdr, fm_error *err)
{
    image_compare_desc compared = { .image = measurement->image,
                                    .reference = reference->wanted,
                                    .covered = covered,
                                    .is_hdr = is_hdr };
    fm_status status = image_compare(&measurement->error, &compared, err);
    const size_t pixels = (size_t)reference->all->width_px * reference->all->height_px;
    measurement->total_error = measurement->error;
    compared.reference = reference->all;
    if (status == FM_OK && memcmp(reference->all->rgba, reference->wanted->rgba, pixels * 16) != 0)
        status = image_compare(&measurement->total_error, &compared, err);
    return status;
}

/* All timed frames drew the image that was compared here. */
static void take_one_image(fm_measurement *m)
{
    const fm_difference *own = &m->error.region[FM_REGION_VIEWPORT].difference;
    m->frames_worst.rmse = own->rmse;
    m->frames_worst.max_abs = own->max_abs;
    m->frames_worst.total_rmse = m->total_error.region[FM_REGION_VIEWPORT].difference.rmse;
    m->has_new_images = true;
}

fm_status measure_check_images(fm_measurement *measurement, const fm_measure_desc *desc,
                               fm_error *err)
{
    fm_reference reference = { 0 };
    bool *covered = covered_pixels(desc->truth);
    fm_status status = covered != NULL ? FM_OK : fm_fail(err, FM_NO_MEMORY, "covered pixels");
    if (status == FM_OK)
        status = reference_create(&reference, desc->truth, measure_k(measurement, desc),
                                  measurement->image, err);
    const double exposure = desc->method->settings->exposure;
    if (status == FM_OK)
        reference_expose(&reference, measurement->image, exposure);
    if (status == FM_OK)
        status = compare_both(measurement, &reference, covered, exposure != 0, err);
    if (status == FM_OK && !measurement->has_new_images)
        take_one_image(measurement);
    measurement->truncation_rmse = reference.truncation_rmse;
    measurement->truth_image = reference.wanted;
    reference.wanted = NULL;
    reference_free(&reference);
    free(covered);
    return status;
}
