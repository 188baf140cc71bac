#include "picture_section.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

#include "draw/pictures.h"
#include "html.h"
#include "read/picture.h"

enum { PAGE_PICTURES_BYTES = 64 << 20 }; /* more would make a page that phones cannot open */

/* One picture of a case, embedded while there is room, with links to its files. */
static fm_status add_picture(fm_writer *to, size_t *embedded, const char *id, const char *kind,
                             const char *caption)
{
    char path[FM_PATH_MAX_BYTES], ending[32];
    struct stat file;
    snprintf(ending, sizeof ending, "%.24s.png", kind);
    fm_status status = picture_path(path, to->results->directory, id, ending, to->err);
    if (status != FM_OK)
        return status;
    if (stat(path, &file) != 0)
        return fm_fail(to->err, FM_IO, "%s: %s", path, strerror(errno));
    *embedded += (size_t)file.st_size;
    text_add(&to->page, "<figure>");
    if (*embedded <= PAGE_PICTURES_BYTES)
        status = html_add_png(&to->page, path, caption, to->err);
    text_add(&to->page, "<figcaption>%s (", caption);
    text_add(&to->page,
             "<a href=\"images/%s%s.png\">PNG</a>, <a href=\"images/%s%s.exr\">EXR</a>"
             ")</figcaption></figure>\n",
             id, kind, id, kind);
    to->outcome->picture_count++;
    return status;
}

static fm_status add_heat_scale(fm_writer *to)
{
    char path[FM_PATH_MAX_BYTES];
    fm_status status = pictures_write_scale(to->results->directory, to->err);
    if (status == FM_OK)
        status = picture_path(path, to->results->directory, "heat-scale", ".png", to->err);
    if (status != FM_OK)
        return status;
    text_add(&to->page, "<p>Pictures are shown over white. The truth beside a picture holds the "
                        "fragments that its method is to keep: the k nearest, or all. The heat map "
                        "is the largest difference "
                        "of a pixel over its four channels, on one scale for all cases; black is "
                        "up to 1e-4. Where timed frames drew different pictures, the range is "
                        "what each pixel was at most in any frame of any launch, less what it was "
                        "at least.</p>\n<div class=scale>");
    status = html_add_png(&to->page, path, "colour bar from 1e-4 to 1", to->err);
    text_add(&to->page, "<div><span>1e-4</span><span>1e-3</span><span>0.01</span><span>0.1</span>"
                        "<span>1</span></div></div>\n");
    return status;
}

enum { CAPTION_BYTES = 192 };

static void heat_caption(char caption[CAPTION_BYTES], const char *what, const fm_heat *heat)
{
    snprintf(caption, CAPTION_BYTES, "%.96s: at most %.3g; %.3g %% of pixels above 1e-4", what,
             heat->most, 100.0 * heat->share);
}

static fm_status add_case_pictures(fm_writer *to, size_t *embedded, const fm_group *group,
                                   const fm_case_row *result, const fm_picture_set *set)
{
    char title[96], caption[CAPTION_BYTES];
    fm_status status = FM_OK;
    group_series_title(title, result, NULL);
    text_add(&to->page, "<h3>");
    html_add(&to->page, title);
    if (group_uses_k(group, result))
        text_add(&to->page, ", k = %.0f", result->k);
    text_add(&to->page, " <span class=faint>");
    html_add(&to->page, group->title);
    text_add(&to->page, ", %s</span></h3>\n<div class=pictures>\n", result->status);
    if (set->has_result)
        status = add_picture(to, embedded, result->id, "", "result");
    if (status == FM_OK && set->has_truth)
        status = add_picture(to, embedded, result->id, ".truth", "truth");
    if (status == FM_OK && set->has_result && set->has_truth) {
        heat_caption(caption, "|difference|", &set->difference);
        status = add_picture(to, embedded, result->id, ".difference", caption);
    }
    if (status == FM_OK && set->has_range) {
        snprintf(title, sizeof title, "range of %.0f pictures in %.0f frames",
                 result->metric[FM_METRIC_DISTINCT_IMAGES], result->metric[FM_METRIC_FRAMES_DRAWN]);
        heat_caption(caption, title, &set->range);
        status = add_picture(to, embedded, result->id, ".range", caption);
    }
    text_add(&to->page, "</div>\n");
    return status;
}

fm_status picture_section_add(fm_writer *to, const fm_groups *groups)
{
    size_t embedded = 0, shown = 0;
    text_add(&to->page, "<h2 id=pictures>Pictures</h2>\n");
    for (size_t i = 0; i < groups->count; i++)
        for (size_t j = 0; j < groups->groups[i].count; j++) {
            const fm_case_row *result = groups->groups[i].cases[j];
            fm_picture_set set;
            fm_status status = pictures_write(&set, to->results->directory, result->id, to->err);
            if (status == FM_OK && (set.has_result || set.has_truth) && shown++ == 0)
                status = add_heat_scale(to);
            if (status == FM_OK && (set.has_result || set.has_truth))
                status = add_case_pictures(to, &embedded, &groups->groups[i], result, &set);
            if (status != FM_OK)
                return status;
        }
    if (shown == 0)
        text_add(&to->page, "<p>This run kept no pictures.</p>\n");
    if (embedded > PAGE_PICTURES_BYTES)
        text_add(&to->page,
                 "<p class=note>Only the first %d MiB of pictures are inside this page; "
                 "all are in images/.</p>\n",
                 PAGE_PICTURES_BYTES >> 20);
    return FM_OK;
}
