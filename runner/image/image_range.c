#include "image_range.h"

#include <errno.h>
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "base/path.h"

static size_t value_count(const fm_image *image)
{
    return (size_t)image->width_px * image->height_px * 4;
}

static fm_status copy(fm_image **to, const fm_image *from, fm_error *err)
{
    const fm_status status = image_create(to, from->width_px, from->height_px, err);
    for (size_t i = 0; status == FM_OK && i < value_count(from); i++)
        (*to)->rgba[i] = isnan(from->rgba[i]) ? INFINITY : from->rgba[i];
    return status;
}

static void widen(fm_image_range *range, const fm_image_range *more)
{
    for (size_t i = 0; i < value_count(range->low); i++) {
        const float low = more->low->rgba[i], high = more->high->rgba[i];
        range->low->rgba[i] = fminf(range->low->rgba[i], isnan(low) ? INFINITY : low);
        range->high->rgba[i] = fmaxf(range->high->rgba[i], isnan(high) ? INFINITY : high);
    }
}

fm_status image_range_join(fm_image_range *range, const fm_image_range *more, fm_error *err)
{
    if (more->low == NULL)
        return FM_OK;
    if (range->low != NULL) {
        const fm_status status = image_check_sizes(more->low, range->low, err);
        if (status == FM_OK)
            widen(range, more);
        return status;
    }
    fm_status status = copy(&range->low, more->low, err);
    if (status == FM_OK)
        status = copy(&range->high, more->high, err);
    if (status != FM_OK)
        image_range_free(range);
    return status;
}

fm_status image_range_add(fm_image_range *range, const fm_image *image, fm_error *err)
{
    fm_image same = *image;
    return image_range_join(range, &(fm_image_range){ &same, &same }, err);
}

void image_range_free(fm_image_range *range)
{
    image_destroy(range->low);
    image_destroy(range->high);
    *range = (fm_image_range){ NULL, NULL };
}

static fm_status range_path(char path[FM_PATH_MAX_BYTES], const char *prefix, const char *ending,
                            fm_error *err)
{
    const int length = snprintf(path, FM_PATH_MAX_BYTES, "%s%s", prefix, ending);
    return length < FM_PATH_MAX_BYTES
               ? FM_OK
               : fm_fail(err, FM_IO, "%.64s...: the path of a range is too long", prefix);
}

static fm_status remove_file(const char *path, fm_error *err)
{
    return unlink(path) == 0 || errno == ENOENT
               ? FM_OK
               : fm_fail(err, FM_IO, "%s: %s", path, strerror(errno));
}

/* Halves are no range (image_range_read), so that it is there at once, and goes at once. */
fm_status image_range_write(const char *prefix, const fm_image_range *range, fm_error *err)
{
    char low[FM_PATH_MAX_BYTES], high[FM_PATH_MAX_BYTES];
    if (prefix[0] == '\0')
        return FM_OK;
    const bool is_empty = range->low == NULL;
    fm_status status = range_path(low, prefix, FM_RANGE_LOW_ENDING, err);
    if (status == FM_OK)
        status = range_path(high, prefix, FM_RANGE_HIGH_ENDING, err);
    if (status == FM_OK)
        status = is_empty ? remove_file(low, err) : image_write(high, range->high, err);
    if (status == FM_OK)
        status = is_empty ? remove_file(high, err) : image_write(low, range->low, err);
    return status;
}

static bool is_absent(const char *path)
{
    return access(path, F_OK) != 0 && errno == ENOENT;
}

fm_status image_range_read(fm_image_range *range, const char *prefix, fm_error *err)
{
    char low[FM_PATH_MAX_BYTES], high[FM_PATH_MAX_BYTES];
    *range = (fm_image_range){ NULL, NULL };
    fm_status status = range_path(low, prefix, FM_RANGE_LOW_ENDING, err);
    if (status == FM_OK)
        status = range_path(high, prefix, FM_RANGE_HIGH_ENDING, err);
    if (status != FM_OK || is_absent(low) || is_absent(high))
        return status;
    status = image_read(&range->low, low, err);
    if (status == FM_OK)
        status = image_read(&range->high, high, err);
    return status == FM_OK ? image_check_sizes(range->low, range->high, err) : status;
}
