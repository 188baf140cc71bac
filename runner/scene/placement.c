#include "placement.h"

/* Where a mesh's instances stand, and from where they are seen. */
#include <inttypes.h>
#include <math.h>
#include <stdlib.h>

/* Columns of camera * translation; false: beyond a float's range. */
static bool place(float clip_from_object[16], const double camera[16], const double offset[3])
{
    for (int i = 0; i < 12; i++)
        clip_from_object[i] = (float)camera[i];
    for (int row = 0; row < 4; row++)
        clip_from_object[12 + row] = (float)(camera[row] * offset[0] + camera[4 + row] * offset[1] +
                                             camera[8 + row] * offset[2] + camera[12 + row]);
    for (int i = 0; i < 16; i++)
        if (!isfinite(clip_from_object[i]))
            return false;
    return true;
}

static const char *name_of(const fm_settings *settings)
{
    const char *file = settings_file(settings);
    return file != NULL ? file : key_find("generator")->values[settings->generator];
}

/* The box of all instances; step: from one to the next. */
static fm_box stretched(double step[3], const fm_settings *settings, const fm_box *box,
                        uint32_t count)
{
    fm_box all = *box;
    for (int axis = 0; axis < 3; axis++) {
        step[axis] = settings->instance_offset[axis] * (box->high[axis] - box->low[axis]);
        all.low[axis] += fmin(0.0, step[axis] * (count - 1));
        all.high[axis] += fmax(0.0, step[axis] * (count - 1));
    }
    return all;
}

fm_status scene_place(fm_scene *scene, const fm_settings *camera, const fm_box *box, fm_error *err)
{
    const uint32_t count = camera->instances > 0 ? camera->instances : 1;
    double step[3], matrix[16];
    const fm_box all = stretched(step, camera, box, count);
    const fm_status status = camera_matrix(matrix, camera, &scene->space, &all, err);
    if (status != FM_OK)
        return status;
    scene->clip_from_object = calloc(count, 16 * sizeof(float));
    if (scene->clip_from_object == NULL)
        return fm_fail(err, FM_NO_MEMORY, "%" PRIu32 " instances", count);
    scene->instances = count;
    for (uint32_t i = 0; i < count; i++)
        if (!place(scene->clip_from_object + (size_t)i * 16, matrix,
                   (double[3]){ i * step[0], i * step[1], i * step[2] }))
            return fm_fail(err, FM_INVALID, "%s: instance %" PRIu32 " is out of a float's range",
                           name_of(&scene->settings), i);
    scene->triangles = (uint64_t)scene->index_count / 3 * count;
    return FM_OK;
}
