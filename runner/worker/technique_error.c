/* How far a technique's frames are from the baseline's, over the whole sequence. */
#include <math.h>
#include <string.h>

#include "answer.h"
#include "image/image_files.h"
#include "technique_internal.h"

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

/* The baseline keeps nothing from frame to frame, so it draws the wrong ones alone. */
static fm_status draw_baseline(technique_run *run, const fm_frame *frame, uint32_t index,
                               fm_error *err)
{
    const tbr_desc desc = { .width_px = run->sequence->width_px,
                            .height_px = run->sequence->height_px };
    fm_status status = run->baseline == NULL ? tbr_create(&run->baseline, &desc, err) : FM_OK;
    if (status == FM_OK)
        status = tbr_frame(run->baseline, frame, err);
    if (status == FM_OK && technique_wrong_tiles(&run->truth, run->baseline, index) > 0)
        status =
            fm_fail(err, FM_IO, "%s: not the truth of this sequence: frame %u is drawn otherwise",
                    run->job->truth, index);
    return status;
}

static void add_error(technique_run *run, const fm_image_error *error)
{
    const fm_region_error *all = &error->region[FM_REGION_VIEWPORT];
    technique_errors *sum = &run->errors;
    sum->squares += all->difference.rmse * all->difference.rmse;
    sum->max_abs = fmax(sum->max_abs, all->difference.max_abs);
    sum->ssim += all->ssim;
    sum->flip += all->flip.mean;
    sum->flip_max = fmax(sum->flip_max, all->flip.max);
}

fm_status technique_compare_frame(technique_run *run, const fm_frame *frame, uint32_t index,
                                  fm_error *err)
{
    fm_image *ours = NULL, *right = NULL;
    fm_image_error error = { 0 };
    const bool is_first = run->outcome.wrong_frames == 1;
    fm_status status = draw_baseline(run, frame, index, err);
    if (status == FM_OK)
        status = float_image(&ours, run, tbr_image(run->gpu), err);
    if (status == FM_OK)
        status = float_image(&right, run, tbr_image(run->baseline), err);
    if (status == FM_OK)
        status =
            image_compare(&error, &(image_compare_desc){ .image = ours, .reference = right }, err);
    if (status == FM_OK && is_first)
        status = image_files_write(run->job->image, ours, right, err);
    if (status == FM_OK)
        add_error(run, &error);
    image_destroy(ours);
    image_destroy(right);
    return status;
}

/* Frames that are right have no error and an ssim of 1; frames smaller than its window have none.
 */
void technique_set_errors(technique_run *run)
{
    const double frames = run->outcome.frames;
    const double right = frames - run->outcome.wrong_frames;
    const technique_errors *sum = &run->errors;
    const bool has_windows =
        run->sequence->width_px >= SSIM_WINDOW_PX && run->sequence->height_px >= SSIM_WINDOW_PX;
    const double rmse = sqrt(sum->squares / frames);
    answer_set_number(run->metrics, FM_METRIC_RMSE, rmse);
    answer_set_number(run->metrics, FM_METRIC_PSNR_DB, rmse > 0 ? -20 * log10(rmse) : INFINITY);
    answer_set_number(run->metrics, FM_METRIC_MAX_ABS, sum->max_abs);
    if (has_windows)
        answer_set_number(run->metrics, FM_METRIC_SSIM, (sum->ssim + right) / frames);
    answer_set_number(run->metrics, FM_METRIC_FLIP, sum->flip / frames);
    answer_set_number(run->metrics, FM_METRIC_FLIP_MAX, sum->flip_max);
    answer_set_count(run->metrics, FM_METRIC_WRONG_TILES, run->outcome.wrong_tiles);
    answer_set_count(run->metrics, FM_METRIC_WRONG_FRAMES, run->outcome.wrong_frames);
}
