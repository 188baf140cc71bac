/* The OpenImageIO shim: image files from pixels. */
#ifndef FM_IMAGE_FILE_H
#define FM_IMAGE_FILE_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#include "base/error.h"

/* pixels: height * width * 3 bytes, sRGB, row 0 at the top. The format follows from the path's
 * ending. FM_IO. */
fm_status image_file_write_rgb8(const char *path, const uint8_t *pixels, uint32_t width_px,
                                uint32_t height_px, fm_error *err);

/* rgba: height * width * 4 floats, linear, premultiplied, row 0 at the top. FM_IO. */
fm_status image_file_write_rgba32f(const char *path, const float *rgba, uint32_t width_px,
                                   uint32_t height_px, fm_error *err);

/* The perceptual colour of a share in [0,1], as bytes: OpenImageIO's "inferno" map. */
fm_status image_file_heat(uint8_t *rgb, const float *shares, uint32_t count, fm_error *err);

#ifdef __cplusplus
}
#endif

#endif
