/* A paper's table of memory against the methods' own byte formulas: needs no device and no run.
 *
 *   table:
 *     added_per_pixel: 4             bytes that the paper books to every method
 *     columns:                       workloads
 *       - { title: 640x480, width_px: 640, height_px: 480, n: 25, k: 8, fragments: 455393 }
 *     rows:
 *       - method: ab-ll
 *         title: Linked Lists        as the paper has it
 *         added_per_pixel: 4         bytes of the published method that ours does without, or -
 *         added_per_pixel_k: -1      the same, for each of k
 *         why: ...                   ... what they are
 *         printed: ["8.73", "22.35", "51.7"]      MiB, as printed; "": not printed
 *         errata: [51.7]             printed values that the paper's own formula does not give
 *
 * Totals that size a buffer are taken to be all fragments, F, but for those that a column names:
 * totals: { kept: 400 }. */
#ifndef FM_MEMORY_TABLE_H
#define FM_MEMORY_TABLE_H

#include "base/text.h"
#include "plugin/plugin.h"

typedef struct fm_memory_verdicts {
    unsigned exact;   /* the printed value, to its last digit */
    unsigned errata;  /* not ours, and known as the paper's error */
    unsigned differs; /* not ours */
} fm_memory_verdicts;

/* Whether the file of a figure has a table. */
fm_status memory_table_is_in(bool *has, const char *path, fm_error *err);
/* Adds rows figure,workload,method,title,bytes,mib,printed,difference_mib,verdict,why; the header
 * too while csv is empty. FM_INVALID: with file and line, or an unknown method. */
fm_status memory_table_make(fm_text *csv, fm_memory_verdicts *verdicts, const char *path,
                            const char *figure, const fm_plugin_list *plugins, fm_error *err);

#endif
