#include "writer.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "draw/svg_png.h"
#include "html.h"

static const double png_zoom = 2.0;

fm_status writer_add_chart(fm_writer *to, fm_chart *chart, fm_status status, const char *name)
{
    char *svg = NULL, path[1280];
    const char *directory = to->results->directory;
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
    snprintf(path, sizeof path, "%s/charts/%s.svg", directory, name);
    status = text_write_file(path, svg, strlen(svg), to->err);
    snprintf(path, sizeof path, "%s/charts/%s.png", directory, name);
    if (status == FM_OK)
        status = svg_png_write(path, svg, png_zoom, to->err);
    text_add(&to->page,
             "<div class=chart>%s</div>\n<p class=links><a href=\"charts/%s.svg\">SVG</a> "
             "<a href=\"charts/%s.png\">PNG</a></p>\n",
             svg, name, name);
    to->outcome->chart_count++;
    free(svg);
    return status;
}
