#include "picture.h"

#include <math.h>
#include <stdio.h>
#include <unistd.h>

#include "image/image_error.h"

fm_status picture_path(char path[FM_PATH_MAX_BYTES], const char *directory, const char *id,
                       const char *ending, fm_error *err)
{
    char name[128];
    snprintf(name, sizeof name, "images/%.64s%.32s", id, ending);
    return path_join(path, directory, name, err);
}

fm_status picture_read(fm_image **image, const char *directory, const char *id, const char *ending,
                       fm_error *err)
{
    char path[FM_PATH_MAX_BYTES];
    *image = NULL;
    const fm_status status = picture_path(path, directory, id, ending, err);
    if (status != FM_OK || access(path, F_OK) != 0)
        return status;
    return image_read(image, path, err);
}

static fm_status read_kept(fm_image **image, const char *directory, const char *id, fm_error *err)
{
    const fm_status status = picture_read(image, directory, id, ".rgba32f", err);
    if (status == FM_OK && *image == NULL)
        return fm_fail(err, FM_UNSUPPORTED, "the picture of case %s was not kept", id);
    return status;
}

fm_status picture_compare(double *max_difference, const char *directory, const char *id,
                          const char *other, fm_error *err)
{
    fm_image *left = NULL, *right = NULL;
    fm_difference apart = { 0 };
    fm_status status = read_kept(&left, directory, id, err);
    if (status == FM_OK)
        status = read_kept(&right, directory, other, err);
    if (status == FM_OK)
        status = image_difference(&apart, left, right, err);
    *max_difference = status == FM_OK ? apart.max_abs : NAN;
    image_destroy(left);
    image_destroy(right);
    return status;
}
