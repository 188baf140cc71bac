/* Wrong tiles and pixels of a sequence as CSV. */
#ifndef FM_FRAME_LINES_H
#define FM_FRAME_LINES_H

#include "base/text.h"
#include "truth/kept_file.h"

/* A wrong tile: the frame, from 0; its number, its upper left pixel and its size; how many of its
 * pixels are wrong. */
#define WRONG_TILES_HEAD "frame,tile,x,y,width,height,wrong_pixels\n"
/* A pixel of a frame: the colour that was drawn, and the one that is right, 0 to 255; state: "ok"
 * or "wrong". */
#define FRAME_LINES_HEAD "frame,x,y,tile,r,g,b,a,right_r,right_g,right_b,right_a,state\n"

/* Pixels of a picture. */
typedef struct pixel_area {
    uint32_t x, y, width, height;
} pixel_area;

/* Sums over all frames of a file. */
typedef struct frame_counts {
    uint64_t frames, wrong_frames, wrong_tiles, wrong_pixels;
} frame_counts;

/* Adds the lines of the first `most` wrong tiles. */
void frame_lines_wrong(fm_text *text, frame_counts *counts, const kept_map *frames, uint64_t most);

/* Adds the pixels of a frame: the wrong ones, or all of an area that is not NULL; *wrong: how many
 * are wrong. A right frame has no line. FM_INVALID: there is no such frame, or its picture was not
 * kept. */
fm_status frame_lines_add(fm_text *text, uint64_t *wrong, const kept_map *frames, uint64_t frame,
                          const pixel_area *area, fm_error *err);

#endif
