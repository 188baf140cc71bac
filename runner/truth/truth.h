/* Truth: every fragment of every pixel, sorted by depth, then arrival; kept in a file that workers
 * map.
 *
 * This room holds what truth is and how captured fragments are held against it. It knows no device:
 * how a device's fragments become a truth is capture/'s. */
#ifndef FM_TRUTH_H
#define FM_TRUTH_H

#include "base/error.h"
#include "image/image.h"
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

/* Maps a file that truth_capture wrote (kept_file.h). FM_IO: it cannot be read, or is damaged;
 * FM_NO_MEMORY. truth_close also of NULL. */
fm_status truth_open(fm_truth **truth, const char *path, fm_error *err);
void truth_close(fm_truth *truth);

/* The truth's own file gets a second name, which outlives the first; where the disk has no such
 * names it is copied. keep: "" or NULL: nothing is done; path: what truth was opened from. FM_IO.
 */
fm_status truth_keep(const char *keep, const char *path, const fm_truth *truth, fm_error *err);

/* Gives the memory of these pixels' fragments back, first to last, half open; the file keeps them:
 * a truth may be larger than memory. */
void truth_forget(const fm_truth *truth, uint64_t first, uint64_t last);

/* Hash of which fragments each pixel has, in their order: equal for equal truths. 48 bits, so that
 * it is a number to every reader of CSV. */
uint64_t truth_digest(const fm_truth *truth);

/* Sum over pixels of min(f, k). */
uint64_t truth_kept(const fm_truth *truth, uint32_t k);

/* One pixel's list, already in order, front to back in double precision. */
void composite_pixel(double rgba[4], const fm_fragment *fragments, uint64_t count);

#endif
