/* Which picture each case drew, as a hash: two runs need no files of pictures to be told apart. */
#ifndef FM_COMPARE_IMAGES_H
#define FM_COMPARE_IMAGES_H

#include "read/result_files.h"

enum { FM_IMAGE_HASH_BYTES = 17 };

/* [results->count]: 16 hex digits if all timed frames of all launches of the case drew the same
 * picture, which the run's journal tells; "": they did not, or it does not tell. */
typedef struct fm_images {
    char (*hashes)[FM_IMAGE_HASH_BYTES]; /* owned */
} fm_images;

/* Reads DIRECTORY/journal.jsonl, if it is there; its damaged lines are left out, which `missing` of
 * the results tells, and so is what is no hash. FM_IO: it cannot be read; FM_INVALID: too long a
 * path; FM_NO_MEMORY. The caller frees. */
fm_status images_read(fm_images *images, const fm_result_files *results, fm_error *err);
void images_free(fm_images *images);

#endif
