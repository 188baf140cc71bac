#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <xxhash.h>

#include "answer.h"
#include "base/image.h"
#include "technique_internal.h"

enum { TRUTH_MAX_BYTES = 1 << 30 };
static const char truth_magic[8] = "fmtbr 1";

static size_t truth_bytes(const sequence_truth_header *header)
{
    return sizeof *header + (size_t)header->frame_count * header->tile_count * 8 +
           (size_t)header->width_px * header->height_px * 4;
}

static uint64_t *truth_hashes(const sequence_truth *truth, uint32_t frame)
{
    return (uint64_t *)(void *)(truth->bytes + sizeof truth->header) +
           (size_t)frame * truth->header.tile_count;
}

char *technique_truth_pixels(const sequence_truth *truth)
{
    return (char *)truth_hashes(truth, truth->header.frame_count);
}

static sequence_truth_header expected_header(const technique_run *run)
{
    sequence_truth_header header = { .width_px = run->sequence->width_px,
                                     .height_px = run->sequence->height_px,
                                     .frame_count = run->sequence->frame_count,
                                     .tile_count = tbr_tile_count(run->gpu) };
    memcpy(header.magic, truth_magic, sizeof header.magic);
    return header;
}

fm_status technique_truth_make(technique_run *run, fm_error *err)
{
    run->truth.header = expected_header(run);
    run->truth.count = truth_bytes(&run->truth.header);
    run->truth.bytes = calloc(1, run->truth.count);
    if (run->truth.bytes == NULL)
        return fm_fail(err, FM_NO_MEMORY, "truth: %zu bytes", run->truth.count);
    memcpy(run->truth.bytes, &run->truth.header, sizeof run->truth.header);
    return FM_OK;
}

fm_status technique_truth_read(technique_run *run, fm_error *err)
{
    const sequence_truth_header expected = expected_header(run);
    const char *path = run->job->truth;
    fm_status status =
        text_read_file(&run->truth.bytes, &run->truth.count, path, TRUTH_MAX_BYTES, err);
    if (status != FM_OK)
        return status;
    if (run->truth.count != truth_bytes(&expected) ||
        memcmp(run->truth.bytes, &expected, sizeof expected) != 0)
        return fm_fail(err, FM_IO, "%s: not the truth of this sequence", path);
    run->truth.header = expected;
    return FM_OK;
}

static uint64_t hash_tile(const technique_run *run, uint32_t tile)
{
    const uint32_t across = tbr_tiles_across(run->gpu), width = run->sequence->width_px;
    const uint32_t x = tile % across * FM_TILE_SIDE, y = tile / across * FM_TILE_SIDE;
    const uint32_t columns = width - x < FM_TILE_SIDE ? width - x : FM_TILE_SIDE;
    const uint32_t left = run->sequence->height_px - y;
    uint64_t hash = 0;
    for (uint32_t row = 0; row < (left < FM_TILE_SIDE ? left : FM_TILE_SIDE); row++)
        hash = XXH64(tbr_image(run->gpu) + (size_t)(y + row) * width + x, 4 * columns, hash);
    return hash;
}

/* How many tiles differ from the truth; or, for the baseline, makes it. */
uint64_t technique_check_frame(technique_run *run, uint32_t frame)
{
    uint64_t *hashes = truth_hashes(&run->truth, frame), wrong = 0;
    for (uint32_t tile = 0; tile < run->truth.header.tile_count; tile++) {
        const uint64_t hash = hash_tile(run, tile);
        if (run->job->method == NULL)
            hashes[tile] = hash;
        else
            wrong += hash != hashes[tile];
    }
    return wrong;
}

/* A frame buffer is opaque: what it shows, as linear floats. */
static fm_status float_image(fm_image **image, const technique_run *run, const uint32_t *pixels,
                             fm_error *err)
{
    const size_t count = (size_t)run->sequence->width_px * run->sequence->height_px;
    const fm_status status =
        image_create(image, run->sequence->width_px, run->sequence->height_px, err);
    for (size_t i = 0; status == FM_OK && i < count; i++) {
        for (unsigned c = 0; c < 3; c++)
            (*image)->rgba[4 * i + c] = (float)(pixels[i] >> 8 * c & 255) / 255.0f;
        (*image)->rgba[4 * i + 3] = 1.0f;
    }
    return status;
}

static void set_errors(json_t *metrics, const fm_image_error *error)
{
    answer_set_number(metrics, FM_METRIC_RMSE, error->rmse);
    answer_set_number(metrics, FM_METRIC_MAX_ABS, error->max_abs);
    answer_set_number(metrics, FM_METRIC_SSIM, error->ssim);
    answer_set_number(metrics, FM_METRIC_PSNR_DB, error->psnr_db);
}

/* The last frame against the baseline's; written only where they differ. */
fm_status technique_compare_last(technique_run *run, fm_error *err)
{
    const size_t bytes = (size_t)run->sequence->width_px * run->sequence->height_px * 4;
    fm_image_error error = { .psnr_db = INFINITY, .ssim = 1 };
    fm_image *ours = NULL, *right = NULL;
    fm_status status = FM_OK;
    uint32_t *pixels = NULL;
    if (memcmp(technique_truth_pixels(&run->truth), tbr_image(run->gpu), bytes) == 0)
        goto out;
    pixels = malloc(bytes);
    if (pixels == NULL) {
        status = fm_fail(err, FM_NO_MEMORY, "no memory for an image");
        goto out;
    }
    memcpy(pixels, technique_truth_pixels(&run->truth), bytes);
    status = float_image(&ours, run, tbr_image(run->gpu), err);
    if (status == FM_OK)
        status = float_image(&right, run, pixels, err);
    if (status == FM_OK)
        status = image_compare(&error, ours, right, err);
    if (status == FM_OK && run->job->image[0] != '\0')
        status = image_write(run->job->image, ours, err);
out:
    if (status == FM_OK)
        set_errors(run->metrics, &error);
    image_destroy(ours);
    image_destroy(right);
    free(pixels);
    return status;
}
