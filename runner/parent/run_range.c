/* What the images of a case's timed frames reach: each launch leaves that of its new images in
 * DIRECTORY/work, and DIRECTORY/images has it of all launches together. */
#include <string.h>
#include <unistd.h>

#include "image/image_range.h"
#include "run_internal.h"

static const char result_ending[] = ".rgba32f";

static bool has_images(const run_state *run, size_t case_index)
{
    return !run->desc->no_images && !run->plan->cases[case_index].no_image;
}

/* Where the range of all launches so far lies, and of the running one. */
typedef struct range_places {
    char all[FM_PATH_MAX_BYTES], launch[FM_PATH_MAX_BYTES];
} range_places;

static fm_status find_places(range_places *places, const run_state *run, size_t case_index,
                             fm_error *err)
{
    const char *id = run->plan->cases[case_index].id;
    const fm_status status = run_path(places->all, run, "images", id, "", err);
    return status == FM_OK ? run_path(places->launch, run, "work", id, "", err) : status;
}

fm_status run_range_path(char path[FM_PATH_MAX_BYTES], const run_state *run, size_t case_index,
                         fm_error *err)
{
    path[0] = '\0';
    if (!has_images(run, case_index))
        return FM_OK;
    return run_path(path, run, "work", run->plan->cases[case_index].id, "", err);
}

/* Of launches that drew one image alone there is that image. */
static fm_status read_all(fm_image_range *all, const range_places *places, fm_error *err)
{
    char path[FM_PATH_MAX_BYTES];
    fm_image *only = NULL;
    fm_status status = image_range_read(all, places->all, err);
    if (status != FM_OK || all->low != NULL)
        return status;
    if (strlen(places->all) + sizeof result_ending > sizeof path)
        return fm_fail(err, FM_INVALID, "%.64s...: too long a path", places->all);
    strcat(strcpy(path, places->all), result_ending);
    if (access(path, F_OK) != 0)
        return FM_OK;
    status = image_read(&only, path, err);
    if (status == FM_OK)
        status = image_range_add(all, only, err);
    image_destroy(only);
    return status;
}

/* Launch 0 begins anew: what lies there is of an attempt that does not count. */
static fm_status join(const range_places *places, uint32_t launch, fm_error *err)
{
    fm_image_range all = { NULL, NULL }, more = { NULL, NULL };
    fm_status status = image_range_read(&more, places->launch, err);
    if (status == FM_OK && launch > 0 && more.low != NULL)
        status = read_all(&all, places, err);
    if (status == FM_OK)
        status = image_range_join(&all, &more, err);
    if (status == FM_OK && (more.low != NULL || launch == 0))
        status = image_range_write(places->all, &all, err);
    image_range_free(&all);
    image_range_free(&more);
    return status;
}

fm_status run_take_range(const run_state *run, size_t case_index, uint32_t launch, bool is_counted,
                         fm_error *err)
{
    static const fm_image_range none = { NULL, NULL };
    range_places places;
    fm_error why = { .message = "" };
    if (!has_images(run, case_index))
        return FM_OK;
    fm_status status = find_places(&places, run, case_index, &why);
    if (status == FM_OK && is_counted)
        status = join(&places, launch, &why);
    if (status == FM_OK)
        status = image_range_write(places.launch, &none, &why);
    return status == FM_OK ? FM_OK : fm_fail(err, FM_IO, "%.2000s", why.message);
}
