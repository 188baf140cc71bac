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

/* A file that is being written: header, offsets, fragments in their place; ranks of arrival, which
 * come last, wait in a temporary file. */
typedef struct truth_file {
    char path[FM_PATH_MAX_BYTES + 16];
    FILE *out;
    FILE *arrival; /* unnamed; NULL: header.has_arrival is 0 */
} truth_file;

/* header: all but magic. Fails with FM_IO; truth_file_close is called in any case. */
fm_status truth_file_open(truth_file *file, const char *path, const truth_header *header,
                          const uint64_t *offsets, fm_error *err);
/* The next fragments, and their ranks if there are any. */
fm_status truth_file_add(truth_file *file, const fm_fragment *fragments, const uint32_t *arrival,
                         size_t count, fm_error *err);
/* Completes the file if status is FM_OK; releases it always; returns the first failure. */
fm_status truth_file_close(truth_file *file, fm_status status, fm_error *err);

#endif
