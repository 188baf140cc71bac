/* Truth: every fragment of every pixel, as this device rasterises the scene; sorted by depth, then
 * arrival; kept in a file that workers map. */
#ifndef FM_TRUTH_H
#define FM_TRUTH_H

#include "base/error.h"
#include "base/image.h"
#include "device/device.h"
#include "scene/scene.h"

typedef struct fm_truth {
    uint32_t width_px, height_px;
    uint32_t n;              /* most fragments of any pixel */
    uint64_t fragment_count; /* F */
    uint64_t nonempty_pixels;
    const uint64_t *offsets;      /* [pixels + 1] */
    const fm_fragment *fragments; /* [F], by pixel, nearest first */
    const uint32_t *arrival; /* [F]: where the i-th arriving fragment of a pixel stands among the
                                pixel's fragments; NULL for flat layers and the feed triangles */
    void *map;
    uint64_t map_bytes;
} fm_truth;

/* Captures the scene (count, prefix sum, store in bands of pixels), sorts it and writes it to path,
 * atomically. A band is what is held in memory. feed: one of FM_FEED_*. FM_FEED_TRIANGLES: as
 * rasterise.h says, whatever the device; the scene is held. Else as the device's rasteriser
 * delivers it; of flat layers without ties it counts all and stores the first band, and while these
 * agree with the closed form, that fills the bands that follow. common_folder: the runner's GLSL.
 */
fm_status truth_capture(const char *path, fm_device *device, const fm_scene *scene, uint32_t feed,
                        const char *common_folder, fm_error *err);
fm_status truth_open(fm_truth **truth, const char *path, fm_error *err);
void truth_close(fm_truth *truth);

/* Gives the memory of these pixels' fragments back, first to last, half open; the file keeps them:
 * a truth may be larger than memory. */
void truth_forget(const fm_truth *truth, uint64_t first, uint64_t last);

/* Sum over pixels of min(f, k). */
uint64_t truth_kept(const fm_truth *truth, uint32_t k);

/* Front to back in double precision: the k nearest, or all with k = 0. The image is created. */
fm_status truth_composite(fm_image **image, const fm_truth *truth, uint32_t k, fm_error *err);
/* The same for one pixel's list, already in order. */
void composite_pixel(double rgba[4], const fm_fragment *fragments, uint64_t count);

#endif
