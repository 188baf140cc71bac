#include "svg_png.h"

#include <cairo.h>
#include <librsvg/rsvg.h>
#include <math.h>
#include <stdint.h>
#include <string.h>

static const double largest_px = 16384;

static fm_status render(const char *path, RsvgHandle *handle, double zoom, fm_error *err)
{
    fm_status status = FM_OK;
    double width = 0, height = 0;
    if (!rsvg_handle_get_intrinsic_size_in_pixels(handle, &width, &height) || !(width >= 1) ||
        !(height >= 1) || width * zoom > largest_px || height * zoom > largest_px)
        return fm_fail(err, FM_INVALID, "%s: a chart of %g x %g pixels", path, width, height);
    cairo_surface_t *surface = cairo_image_surface_create(
        CAIRO_FORMAT_RGB24, (int)ceil(width * zoom), (int)ceil(height * zoom));
    cairo_t *cairo = cairo_create(surface);
    RsvgRectangle viewport = { 0, 0, width * zoom, height * zoom };
    cairo_set_source_rgb(cairo, 1, 1, 1);
    cairo_paint(cairo);
    if (!rsvg_handle_render_document(handle, cairo, &viewport, NULL))
        status = fm_fail(err, FM_INVALID, "%s: librsvg could not draw the chart", path);
    else if (cairo_surface_write_to_png(surface, path) != CAIRO_STATUS_SUCCESS)
        status = fm_fail(err, FM_IO, "%s: could not be written", path);
    cairo_destroy(cairo);
    cairo_surface_destroy(surface);
    return status;
}

fm_status svg_png_write(const char *path, const char *svg, double zoom, fm_error *err)
{
    GError *problem = NULL;
    RsvgHandle *handle = rsvg_handle_new_from_data((const guint8 *)svg, strlen(svg), &problem);
    if (handle == NULL) {
        fm_fail(err, FM_INVALID, "%s: librsvg: %s", path, problem->message);
        g_error_free(problem);
        return FM_INVALID;
    }
    fm_status status = render(path, handle, zoom, err);
    g_object_unref(handle);
    return status;
}
