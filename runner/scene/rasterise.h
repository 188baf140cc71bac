/* The rasteriser of the feed `triangles`, on the host: the truth of that feed. Its rules are stated
 * here, and methods/common/rasterise.glsl is its twin on the device, bit for bit:
 *
 *   numbers    float means IEEE single, each operation rounded on its own (no fused multiply-add);
 *              1/v is four Newton steps r = r (2 - v r) from the bits 0x7EF311C7 - bits(v), and
 *              1/1 is 1: no device divides alike
 *   clip       a triangle with a coordinate of 2^64 or more (or none) is dropped, and so is one
 *              whose corners all lie outside one plane. Planes: w >= 2^-40, z >= 0, z <= w, and the
 *              guard band |x| <= gx w, |y| <= gy w, gx and gy the largest powers of two that keep
 *              32 768 px from the viewport's middle. Else the polygon is cut plane by plane, each
 *              new corner = inside + (outside - inside) di / (di - do), and becomes a fan
 *   snap       x = floor((x / w) W/2 256 + W/2 256 + 1/2), in 1/256 px; z = z / w, clamped to [0,
 * 1] coverage   a pixel's centre, half-open by the top-left rule; both orientations; exact integers
 *   depth      z0 + (gx (x - x0) + gy (y - y0)) at the pixel's centre, x and y in 1/256 px, clamped
 *              to the z of the corners; below 2^-126 it is 0
 *   order      a triangle's number is its place in drawing order; parts of a fan share it */
#ifndef FM_RASTERISE_H
#define FM_RASTERISE_H

#include <stdbool.h>
#include <stdint.h>

enum {
    RASTER_SUBPIXELS = 256,
    RASTER_GUARD_PX = 32768,
    RASTER_PLANES = 7,
    RASTER_CORNERS_MAX = 3 + RASTER_PLANES, /* of a clipped polygon */
};

/* x y z w before the division. */
typedef struct fm_clip_corner {
    float x, y, z, w;
} fm_clip_corner;

typedef struct fm_raster_target {
    uint32_t width_px, height_px;
    uint32_t first_row, last_row; /* only these rows, last_row not included */
    void (*fragment)(void *context, uint32_t x, uint32_t y, float depth);
    void *context;
} fm_raster_target;

/* Calls target->fragment for each pixel that the triangle covers, row by row in each part. */
void rasterise_triangle(const fm_raster_target *target, const fm_clip_corner corners[3]);

/* Largest power of two g with g * size_px / 2 <= RASTER_GUARD_PX. */
float raster_guard(uint32_t size_px);

/* Whether the triangle has to be clipped (or dropped): the device leaves clipping out of its
 * shaders for scenes where no triangle has. */
bool raster_needs_clip(uint32_t width_px, uint32_t height_px, const fm_clip_corner corners[3]);

#endif
