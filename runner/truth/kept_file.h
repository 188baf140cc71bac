/* Lists on disk: one format for every fragment of a truth, those that a method handed over, and the
 * wrong tiles of a sequence. A file is, one after the other:
 *
 *   kept_header                   64 bytes
 *   offsets [list_count + 1]      uint64_t: list i holds the items from offsets[i] on, up to
 *                                 offsets[i + 1]; the first is 0, the last is item_count
 *   items   [item_count]          8 bytes each
 *   words   [word_count]          uint32_t
 *
 * What a list and an item are, and the words:
 *
 * - truth: a list for each pixel, of fm_fragment. Words: for each item, which place the i-th
 * fragment to arrive at the pixel has in its list; or none.
 * - fragments: a list for each pixel, of fm_fragment. Words: for each pixel, how many more were
 * handed over than there was room to capture.
 * - frames: a list for each frame, of kept_tile. Words: for each of the first frames with wrong
 * tiles, the picture and then the one that it should have been, RGBA8.
 *
 * Pixels are row by row from the upper left. A list of truth is nearest first; one of fragments is
 * in the order of ranks; one of frames rises by tiles. Numbers are as the machine has them:
 * little-endian wherever fragmark runs. */
#ifndef FM_KEPT_FILE_H
#define FM_KEPT_FILE_H

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

#include "base/error.h"
#include "base/path.h"

typedef enum kept_kind { KEPT_FRAGMENTS, KEPT_TRUTH, KEPT_FRAMES, KEPT_KIND_COUNT } kept_kind;
/* "fragments", "truth", "frames": what `run --keep` calls them, and how their files end. */
extern const char *const kept_names[KEPT_KIND_COUNT];

typedef struct kept_header {
    char magic[8]; /* "fmkept1" */
    uint32_t kind; /* kept_kind */
    uint32_t width_px, height_px;
    uint32_t wanted;   /* of fragments: how many of a pixel, from the front, the method was to hand
                          over; UINT32_MAX: all. Of other kinds 0 */
    uint32_t n;        /* most items of a list */
    uint32_t reserved; /* 0 */
    uint64_t list_count, item_count, word_count;
    uint64_t nonempty; /* lists with an item */
} kept_header;
_Static_assert(sizeof(kept_header) == 64, "no padding in the file");

/* A tile that is not as it should be: KEPT_TILE_SIDE px wide and high, fewer at the right and lower
 * edge; its number counts row by row from the upper left. */
enum { KEPT_TILE_SIDE = 16, KEPT_ITEM_BYTES = 8 };
typedef struct kept_tile {
    uint32_t tile, wrong_pixels;
} kept_tile;
_Static_assert(sizeof(kept_tile) == KEPT_ITEM_BYTES, "an item of a file");

/* Tiles in a row, and all of them. */
uint32_t kept_tiles_across(const kept_header *header);
uint64_t kept_tile_count(const kept_header *header);

/* ---- writing ---- */

/* A file on its way: PATH.partial until all of it is written. Lists are added one after the other.
 * Failures wait for kept_finish. */
typedef struct kept_writer {
    char path[FM_PATH_MAX_BYTES], partial[FM_PATH_MAX_BYTES + 16];
    FILE *out;
    FILE *words;       /* unnamed: they come last */
    uint64_t *offsets; /* [list_count + 1] */
    uint64_t lists;    /* added so far */
    kept_header header;
    int failure; /* errno of the first that failed */
} kept_writer;

/* header: kind, sizes, wanted and list_count; the rest is counted. kept_finish is called in any
 * case. FM_IO, FM_NO_MEMORY. */
fm_status kept_begin(kept_writer *writer, const char *path, const kept_header *header,
                     fm_error *err);
/* The next list; items of KEPT_ITEM_BYTES each. At most list_count. */
void kept_add_list(kept_writer *writer, const void *items, size_t count);
void kept_add_words(kept_writer *writer, const uint32_t *words, size_t count);
/* If status is FM_OK and all lists are there, the file takes its place, whole; else nothing is left
 * of it. Releases the writer, which may be {0}; returns the first failure. */
fm_status kept_finish(kept_writer *writer, fm_status status, fm_error *err);

/* ---- reading ---- */

/* A file that is mapped. Starts as {0}; is {0} after a failure, but for is_damaged. */
typedef struct kept_map {
    const kept_header *header;
    const uint64_t *offsets;
    const void *items; /* fm_fragment or kept_tile */
    const uint32_t *words;
    void *map;
    uint64_t map_bytes;
    bool is_damaged; /* FM_IO because of what is in the file */
} kept_map;

/* Maps a file and checks all that readers rely on: sizes, offsets, words, tiles; not whether a list
 * of truth rises. FM_INVALID: a folder, a device or a pipe. FM_IO: it cannot be opened, or is no
 * such file, or is damaged: the message says what is wrong. FM_NO_MEMORY. kept_close in any case.
 */
fm_status kept_open(kept_map *map, const char *path, fm_error *err);
void kept_close(kept_map *map);

/* The pictures of a frame with wrong tiles, the drawn and the right one, each width x height;
 * false: they are not in the file. frame: below list_count. */
bool kept_pictures(const uint32_t *pictures[2], const kept_map *map, uint64_t frame);

#endif
