/* The truth file: header, offsets, fragments, and (not for flat layers) ranks of arrival. */
#ifndef FM_TRUTH_FILE_H
#define FM_TRUTH_FILE_H

#include <stdio.h>

#include "truth.h"

/* At the start of the file; the arrays follow in the order of fm_truth, each 8-byte aligned. */
typedef struct truth_header {
    char magic[8]; /* "fmtruth1" */
    uint32_t width_px, height_px;
    uint32_t n;
    uint32_t has_arrival;
    uint64_t fragment_count;
    uint64_t nonempty_pixels;
} truth_header;
_Static_assert(sizeof(truth_header) == 40, "no padding in the file");

/* Parts of a file that is being written. */
typedef struct truth_file {
    char path[FM_PATH_MAX_BYTES + 16];
    FILE *fragments, *arrival; /* temporary, unnamed */
} truth_file;

fm_status truth_file_open(truth_file *file, const char *path, fm_error *err);
/* Joins the parts if status is FM_OK; releases them always; returns the first failure. */
fm_status truth_file_close(truth_file *file, fm_status status, const truth_header *header,
                           const uint64_t *offsets, fm_error *err);

#endif
