/* reports/figures/ID.yml: one figure of a paper as data. `fragmark reproduce` measures what it
 * `run`s, fragmark-report draws its charts and judges its claims; both read its head here.
 *
 *   id: kplus-05               the file's name
 *   paper: kplus
 *   title: ...
 *   source: where in the paper, and how its values were read
 *   run:                       what `fragmark reproduce` measures: keys of a spec file, or a list
 *                              of such blocks
 *     methods: [kplus-array, ...]
 *     scenes: [layers]
 *     feeds: [raster]
 *     k: [4, 8]
 *   smoke: { n: 32 }           what --smoke changes in each block of `run`
 *   large: [blocks]            what --large measures too
 *   pictures: true             pictures and heat maps of its cases are kept; default false
 *   untimed: true              it is about errors or bytes: one launch is enough, and the report of
 *                              such figures alone does not warn of it; default false
 *   charts: ...                in the report's order: reports/read/paper_figure.h; without them,
 *                              those that every report has
 *   paper_points: ...          the values that the paper prints: there too
 *   claims: ...                reports/read/claim.h
 *   deviations: [sentences]
 *   table: ...                 memory by formula: plan/memory_table.h
 *
 * Unknown keys are refused with file, line and the nearest known one. */
#ifndef FM_FIGURE_FILE_H
#define FM_FIGURE_FILE_H

#include <stdbool.h>

#include "base/error.h"
#include "base/yaml_tree.h"

/* All texts and parts point into the tree. */
typedef struct fm_figure_file {
    const char *id, *paper, *title, *source; /* "": missing */
    bool keeps_pictures, is_untimed;
    /* Parts; NULL: missing. Their own readers check them. */
    const fm_yaml *run, *smoke, *large, *charts, *paper_points, *claims, *deviations, *table;
    fm_yaml *tree; /* owned */
} fm_figure_file;

/* FM_IO, FM_NO_MEMORY; FM_INVALID: not YAML, a key that no figure has, an id with other letters
 * than a-z, 0-9 and '-', or no id, paper or title. Of a file that is YAML the fields are set all
 * the same, for who lists damaged figures too. The caller closes the file, on failure too. */
fm_status figure_file_read(fm_figure_file *file, const char *path, fm_error *err);
void figure_file_close(fm_figure_file *file);

#endif
