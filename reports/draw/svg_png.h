/* PNG from SVG, through librsvg and cairo. */
#ifndef FM_SVG_PNG_H
#define FM_SVG_PNG_H

#include "base/error.h"

/* Draws the SVG text at `zoom` times its size on white. FM_INVALID: not SVG, or too large; FM_IO.
 */
fm_status svg_png_write(const char *path, const char *svg, double zoom, fm_error *err);

#endif
