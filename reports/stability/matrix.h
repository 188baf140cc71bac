/* Methods by scenes: the worst that each did there. */
#ifndef FM_MATRIX_H
#define FM_MATRIX_H

#include "blame.h"
#include "read/result_files.h"

typedef struct fm_stability_cell {
    const fm_case_row *row; /* the case that a reader has to look at first; NULL: there is none */
    fm_blame blame;         /* of that case */
    size_t cases;           /* of this method and scene: of several k, options, ... */
    size_t open;            /* of them, those that are unexplained */
} fm_stability_cell;

/* One device and feed. */
typedef struct fm_stability_matrix {
    const char *device, *device_name, *feed;
    const fm_case_row **methods; /* [method_count]: a case of each; owned */
    const char **scenes;         /* [scene_count]; owned */
    size_t method_count, scene_count;
    fm_stability_cell *cells; /* [method_count][scene_count]; owned */
} fm_stability_matrix;

typedef struct fm_stability_matrices {
    fm_stability_matrix *items; /* in the order of their first cases; owned */
    size_t count;
    size_t cases, open; /* of all: those that have a verdict, and the unexplained ones */
} fm_stability_matrices;

/* Of all cases but floors; methods and scenes in the order of their first cases. The results must
 * outlive it. FM_NO_MEMORY; the caller frees it, after a failure too. */
fm_status matrices_make(fm_stability_matrices *matrices, const fm_result_files *results,
                        fm_error *err);
void matrices_free(fm_stability_matrices *matrices);

const fm_stability_cell *matrix_cell(const fm_stability_matrix *matrix, size_t method,
                                     size_t scene);

#endif
