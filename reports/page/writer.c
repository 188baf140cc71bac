#include "writer.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/path.h"
#include "draw/svg_png.h"
#include "html.h"
#include "publish.h"

static const double png_zoom = 2.0;

/* NAME ENDING, where charts wait until the report is done. */
static fm_status chart_path(char path[FM_PATH_MAX_BYTES], const fm_writer *to, const char *name,
                            const char *ending)
{
    char file[320];
    snprintf(file, sizeof file, FM_PUBLISH_CHARTS "/%.256s%s", name, ending);
    return path_join(path, to->results->directory, file, to->err);
}

static fm_status write_files(const fm_writer *to, const char *svg, const char *name)
{
    char path[FM_PATH_MAX_BYTES];
    fm_status status = chart_path(path, to, name, ".svg");
    if (status == FM_OK)
        status = text_write_file(path, svg, strlen(svg), to->err);
    if (status == FM_OK)
        status = chart_path(path, to, name, ".png");
    return status != FM_OK ? status : svg_png_write(path, svg, png_zoom, to->err);
}

fm_status writer_add_chart(fm_writer *to, fm_chart *chart, fm_status status, const char *name)
{
    char *svg = NULL;
    if (status == FM_UNSUPPORTED) {
        text_add(&to->page, "<p class=note>No chart: ");
        html_add(&to->page, to->err->message);
        text_add(&to->page, ".</p>\n");
        chart_free(chart);
        return FM_OK;
    }
    if (status == FM_OK)
        status = chart_svg(&svg, chart, to->err);
    chart_free(chart);
    if (status != FM_OK)
        return status;
    status = write_files(to, svg, name);
    text_add(&to->page,
             "<div class=chart>%s</div>\n<p class=links><a href=\"charts/%s.svg\">SVG</a> "
             "<a href=\"charts/%s.png\">PNG</a></p>\n",
             svg, name, name);
    to->outcome->chart_count++;
    free(svg);
    return status;
}
