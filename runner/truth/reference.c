#include "reference.h"

#include <math.h>
#include <stdlib.h>

#include "loss.h"

/* A pass over all pixels. */
typedef struct pixel_walk {
    const fm_truth *truth;
    fm_ties *ties, *all_ties; /* of the wanted, and of all fragments */
    uint32_t wanted;
} pixel_walk;

/* The range of a pixel's first `wanted` fragments: a point, where their order is not open. */
static void find_range(fm_range *range, const pixel_walk *walk, uint64_t pixel, uint32_t wanted)
{
    const fm_truth *truth = walk->truth;
    const fm_fragment *fragments = &truth->fragments[truth->offsets[pixel]];
    const uint32_t count = (uint32_t)(truth->offsets[pixel + 1] - truth->offsets[pixel]);
    if (ties_are_open(fragments, count, wanted)) {
        ties_range(range, wanted == UINT32_MAX ? walk->all_ties : walk->ties, fragments, count,
                   wanted);
        return;
    }
    composite_pixel(range->low, fragments, wanted < count ? wanted : count);
    for (int c = 0; c < 4; c++)
        range->high[c] = range->low[c];
}

/* Rows of truth are given back when they are done with. */
static void forget_row(const pixel_walk *walk, uint64_t pixel)
{
    const uint32_t width = walk->truth->width_px;
    if ((pixel + 1) % width == 0)
        truth_forget(walk->truth, pixel + 1 - width, pixel + 1);
}

static fm_status begin(pixel_walk *walk, const fm_truth *truth, uint32_t wanted, fm_error *err)
{
    *walk = (pixel_walk){ .truth = truth, .wanted = wanted };
    const fm_status status = ties_create(&walk->ties, truth->n, err);
    return status == FM_OK ? ties_create(&walk->all_ties, truth->n, err) : status;
}

static void end(pixel_walk *walk)
{
    ties_destroy(walk->ties);
    ties_destroy(walk->all_ties);
}

double range_distance(const fm_range *range, const float rgba[4])
{
    double largest = 0;
    for (int c = 0; c < 4; c++) {
        const double value = (double)rgba[c];
        if (!isfinite(value))
            return INFINITY;
        largest = fmax(largest, fmax(range->low[c] - value, value - range->high[c]));
    }
    return largest;
}

static void set_nearest(float *nearest, const fm_range *range, const float *rgba)
{
    for (int c = 0; c < 4; c++)
        nearest[c] = (float)fmin(fmax((double)rgba[c], range->low[c]), range->high[c]);
}

/* Adds the squared distance of the first `wanted` from all, in truth's order. */
static void add_truncation(double square[2], const pixel_walk *walk, uint64_t pixel)
{
    const fm_truth *truth = walk->truth;
    const uint64_t first = truth->offsets[pixel], count = truth->offsets[pixel + 1] - first;
    double kept[4], all[4];
    if (count <= walk->wanted)
        return;
    composite_pixel(kept, &truth->fragments[first], walk->wanted);
    composite_pixel(all, &truth->fragments[first], count);
    for (int c = 0; c < 4; c++)
        square[c / 3] += (kept[c] - all[c]) * (kept[c] - all[c]);
}

static void set_truncation(fm_reference *reference)
{
    reference->truncation_rmse =
        sqrt(reference->truncation_square[0] + reference->truncation_square[1]);
}

fm_status reference_create(fm_reference *reference, const fm_truth *truth, uint32_t wanted,
                           const fm_image *image, fm_error *err)
{
    const uint64_t pixels = (uint64_t)truth->width_px * truth->height_px;
    pixel_walk walk;
    *reference = (fm_reference){ 0 };
    if (image->width_px != truth->width_px || image->height_px != truth->height_px)
        return fm_fail(err, FM_INVALID, "an image of %u x %u px, and a truth of %u x %u px",
                       image->width_px, image->height_px, truth->width_px, truth->height_px);
    fm_status status = begin(&walk, truth, wanted, err);
    if (status == FM_OK)
        status = image_create(&reference->wanted, truth->width_px, truth->height_px, err);
    if (status == FM_OK)
        status = image_create(&reference->all, truth->width_px, truth->height_px, err);
    for (uint64_t i = 0; i < pixels && status == FM_OK; i++) {
        fm_range range;
        find_range(&range, &walk, i, wanted);
        set_nearest(&reference->wanted->rgba[4 * i], &range, &image->rgba[4 * i]);
        if (truth->offsets[i + 1] - truth->offsets[i] > wanted)
            find_range(&range, &walk, i, UINT32_MAX);
        set_nearest(&reference->all->rgba[4 * i], &range, &image->rgba[4 * i]);
        add_truncation(reference->truncation_square, &walk, i);
        forget_row(&walk, i);
    }
    for (int part = 0; part < 2; part++)
        reference->truncation_square[part] /= 4.0 * (double)pixels;
    set_truncation(reference);
    end(&walk);
    return status;
}

void reference_free(fm_reference *reference)
{
    image_destroy(reference->wanted);
    image_destroy(reference->all);
    *reference = (fm_reference){ 0 };
}

static float exposed(float value, double scale)
{
    return (float)((double)value * scale);
}

static void expose(fm_image *image, double scale)
{
    const size_t values = 4 * (size_t)image->width_px * image->height_px;
    for (size_t i = 0; i < values; i++)
        if (i % 4 != 3)
            image->rgba[i] = exposed(image->rgba[i], scale);
}

void reference_expose_image(fm_image *image, double stops)
{
    if (fabs(stops) > 0) /* else the same picture, to the bit */
        expose(image, exp2(stops));
}

void reference_expose(fm_reference *reference, fm_image *image, double stops)
{
    const double scale = exp2(stops);
    if (!(fabs(stops) > 0)) /* the same pictures, to the bit */
        return;
    expose(image, scale);
    expose(reference->wanted, scale);
    expose(reference->all, scale);
    reference->truncation_square[0] *= scale * scale;
    set_truncation(reference);
}

/* The largest distance at one pixel of all images. */
static double pixel_distance(const pixel_walk *walk, const reference_images *compared,
                             uint64_t pixel)
{
    const uint64_t first = walk->truth->offsets[pixel];
    const uint32_t count = (uint32_t)(walk->truth->offsets[pixel + 1] - first);
    double largest = 0;
    fm_range range;
    if (loss_may_touch(compared->traits, &walk->truth->fragments[first],
                       count < compared->wanted ? count : compared->wanted))
        return 0;
    find_range(&range, walk, pixel, compared->wanted);
    for (size_t i = 0; i < compared->count; i++)
        largest = fmax(largest, range_distance(&range, &compared->images[i]->rgba[4 * pixel]));
    return fmax(0, largest - rounding_bound(compared->rounding, &walk->truth->fragments[first],
                                            count, compared->wanted));
}

fm_status reference_distance(double *max_abs, const reference_images *compared, fm_error *err)
{
    const fm_truth *truth = compared->truth;
    const uint64_t pixels = (uint64_t)truth->width_px * truth->height_px;
    pixel_walk walk;
    const fm_status status = begin(&walk, truth, compared->wanted, err);
    *max_abs = 0;
    for (uint64_t i = 0; i < pixels && status == FM_OK; i++) {
        *max_abs = fmax(*max_abs, pixel_distance(&walk, compared, i));
        forget_row(&walk, i);
    }
    end(&walk);
    return status;
}

/* The sums of one image. */
typedef struct image_sums {
    difference_sums wanted, all;
} image_sums;

/* Adds a pixel's distance from the nearest that the range allows. */
static void add_distance(difference_sums *sums, const fm_range *range, const float rgba[4],
                         double scale)
{
    float nearest[4], image[4];
    set_nearest(nearest, range, rgba);
    for (int c = 0; c < 4; c++) {
        image[c] = c < 3 ? exposed(rgba[c], scale) : rgba[c];
        nearest[c] = c < 3 ? exposed(nearest[c], scale) : nearest[c];
    }
    difference_add(sums, image, nearest);
}

static void add_distances(image_sums *sums, const pixel_walk *walk,
                          const reference_images *compared, uint64_t pixel, double scale)
{
    const uint64_t *offsets = &walk->truth->offsets[pixel];
    fm_range wanted, all;
    find_range(&wanted, walk, pixel, compared->wanted);
    all = wanted;
    if (offsets[1] - offsets[0] > compared->wanted)
        find_range(&all, walk, pixel, UINT32_MAX);
    for (size_t i = 0; i < compared->count; i++) {
        const float *rgba = &compared->images[i]->rgba[4 * pixel];
        add_distance(&sums[i].wanted, &wanted, rgba, scale);
        add_distance(&sums[i].all, &all, rgba, scale);
    }
}

static void take_worst(fm_worst_error *worst, const image_sums *sums)
{
    const fm_difference wanted = difference_of(&sums->wanted), all = difference_of(&sums->all);
    worst->rmse = fmax(worst->rmse, wanted.rmse);
    worst->max_abs = fmax(worst->max_abs, wanted.max_abs);
    worst->total_rmse = fmax(worst->total_rmse, all.rmse);
}

fm_status reference_worst(fm_worst_error *worst, const reference_images *compared, double stops,
                          fm_error *err)
{
    const fm_truth *truth = compared->truth;
    const uint64_t pixels = (uint64_t)truth->width_px * truth->height_px;
    pixel_walk walk;
    image_sums *sums = calloc(compared->count + 1, sizeof *sums);
    fm_status status = begin(&walk, truth, compared->wanted, err);
    if (status == FM_OK && sums == NULL)
        status = fm_fail(err, FM_NO_MEMORY, "errors of %zu images", compared->count);
    for (uint64_t i = 0; i < pixels && status == FM_OK; i++) {
        add_distances(sums, &walk, compared, i, exp2(stops));
        forget_row(&walk, i);
    }
    for (size_t i = 0; i < compared->count && status == FM_OK; i++)
        take_worst(worst, &sums[i]);
    end(&walk);
    free(sums);
    return status;
}

uint64_t truth_tied_pixels(const fm_truth *truth, uint32_t wanted)
{
    const uint64_t pixels = (uint64_t)truth->width_px * truth->height_px;
    const pixel_walk walk = { .truth = truth };
    uint64_t tied = 0;
    for (uint64_t i = 0; i < pixels; i++) {
        const uint64_t first = truth->offsets[i];
        tied += ties_are_open(&truth->fragments[first], (uint32_t)(truth->offsets[i + 1] - first),
                              wanted);
        forget_row(&walk, i);
    }
    return tied;
}
