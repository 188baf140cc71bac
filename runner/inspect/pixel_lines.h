/* Pixels of a case as CSV: every fragment that was handed over, and those that are missing. */
#ifndef FM_PIXEL_LINES_H
#define FM_PIXEL_LINES_H

#include "base/text.h"
#include "truth/kept_file.h"

/* Columns of a fragment, with the end of the line. rank: its place among those handed over;
 * true_rank: its place among the pixel's; both from 0, and empty where it has none. depth_bits: the
 * float, in hexadecimal digits. r, g, b, a: 0 to 255, premultiplied. state: a word of states.h, and
 * "+misordered" or "misordered" where it is nearer than the one before; of what was handed over
 * without truth beside it, nothing else is known, and of truth alone nothing. */
#define PIXEL_LINES_HEAD "x,y,rank,depth,depth_bits,r,g,b,a,state,true_rank\n"
/* Columns of a wrong pixel: how many are its own, are wanted, were handed over; check.h says what
 * is missing, extra and misordered. */
#define WRONG_PIXELS_HEAD "x,y,true,wanted,handed_over,missing,extra,misordered\n"

/* One of them may be NULL; both are of pictures of the same size. */
typedef struct pixel_source {
    const kept_map *fragments, *truth;
} pixel_source;

/* Of one pixel, or sums over some. */
typedef struct pixel_counts {
    uint64_t own, wanted, handed_over, missing, extra, misordered;
    uint64_t uncaptured; /* of those handed over: there was no room for them, so that they have no
                            line; they are extra */
} pixel_counts;

/* Adds the lines of a pixel, by its number, to text, and its counts to *sums. text may be NULL: it
 * is only counted. FM_NO_MEMORY. */
fm_status pixel_lines_add(fm_text *text, pixel_counts *sums, const pixel_source *source,
                          uint64_t pixel, fm_error *err);
/* Adds the lines of the first `most` wrong pixels, and to *sums the counts of all pixels;
 * *wrong: how many are wrong. Needs both. FM_NO_MEMORY. */
fm_status pixel_lines_wrong(fm_text *text, pixel_counts *sums, uint64_t *wrong,
                            const pixel_source *source, uint64_t most, fm_error *err);

#endif
