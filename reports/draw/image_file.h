/* The OpenImageIO shim: image files from pixels, and pixels from image files. */
#ifndef FM_IMAGE_FILE_H
#define FM_IMAGE_FILE_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#include "base/error.h"
#include "image/image.h"

/* pixels: height * width * 3 bytes, sRGB, row 0 at the top. The format follows from the path's
 * ending. FM_IO. */
fm_status image_file_write_rgb8(const char *path, const uint8_t *pixels, uint32_t width_px,
                                uint32_t height_px, fm_error *err);

/* rgba: height * width * 4 floats, linear, premultiplied, row 0 at the top. FM_IO. */
fm_status image_file_write_rgba32f(const char *path, const float *rgba, uint32_t width_px,
                                   uint32_t height_px, fm_error *err);

/* How the colours of a file are coded. */
typedef enum fm_transfer {
    FM_TRANSFER_BY_FORMAT, /* sRGB where a channel is an integer (PNG), linear where it is a float
                              (EXR, PFM) */
    FM_TRANSFER_SRGB,
    FM_TRANSFER_LINEAR
} fm_transfer;

/* Any format that OpenImageIO reads, of one (grey), two (grey, alpha), three or four channels, as
 * linear, premultiplied RGBA; without alpha it is 1. FM_INVALID: no regular file, no such image,
 * other channels, or too large; FM_IO; FM_NO_MEMORY. The caller destroys *image. */
fm_status image_file_read(fm_image **image, const char *path, fm_transfer transfer, fm_error *err);

/* Pixels in which a person sees a difference, by the metric of Yee and Newman 2004 for a display of
 * 100 cd/m2 that fills 45 degrees; of RGB, as the pictures are shown. */
fm_status image_file_yee(uint64_t *pixels, const fm_image *image, const fm_image *reference,
                         fm_error *err);

/* values: height * width floats. FM_IO. */
fm_status image_file_write_grey32f(const char *path, const float *values, uint32_t width_px,
                                   uint32_t height_px, fm_error *err);

/* The perceptual colour of a share in [0,1], as bytes: OpenImageIO's "inferno" map. */
fm_status image_file_heat(uint8_t *rgb, const float *shares, uint32_t count, fm_error *err);

#ifdef __cplusplus
}
#endif

#endif
