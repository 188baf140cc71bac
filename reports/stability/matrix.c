#include "matrix.h"

#include <stdlib.h>
#include <string.h>

#include "base/text_index.h"

/* The matrix that is being filled, and where its methods and scenes are. */
typedef struct matrix_axes {
    fm_stability_matrix *matrix;
    fm_text_index methods, scenes;
} matrix_axes;

static bool is_of(const fm_stability_matrix *matrix, const fm_case_row *row)
{
    return strcmp(matrix->device, row->device) == 0 && strcmp(matrix->feed, row->feed) == 0;
}

static fm_stability_matrix *find_matrix(fm_stability_matrices *matrices, const fm_case_row *row)
{
    for (size_t i = 0; i < matrices->count; i++)
        if (is_of(&matrices->items[i], row)) {
            if (matrices->items[i].device_name[0] == '\0') /* what never ran does not know it */
                matrices->items[i].device_name = row->device_name;
            return &matrices->items[i];
        }
    fm_stability_matrix *grown =
        realloc(matrices->items, (matrices->count + 1) * sizeof matrices->items[0]);
    if (grown == NULL)
        return NULL;
    matrices->items = grown;
    grown[matrices->count] = (fm_stability_matrix){ .device = row->device,
                                                    .device_name = row->device_name,
                                                    .feed = row->feed };
    return &grown[matrices->count++];
}

static bool has_verdict(const fm_case_row *row)
{
    return blame_case(row).verdict != FM_STABILITY_NONE;
}

static bool find_matrices(fm_stability_matrices *matrices, const fm_result_files *results)
{
    for (size_t i = 0; i < results->count; i++)
        if (has_verdict(&results->cases[i]) && find_matrix(matrices, &results->cases[i]) == NULL)
            return false;
    return true;
}

/* Whether a is worse than b: unexplained before explained, then by verdict, then by size. */
static bool is_worse(const fm_blame *a, const fm_case_row *row_a, const fm_blame *b,
                     const fm_case_row *row_b)
{
    if (blame_is_open(a) != blame_is_open(b))
        return blame_is_open(a);
    if (a->verdict != b->verdict)
        return a->verdict > b->verdict;
    if (a->missing_share > b->missing_share || a->missing_share < b->missing_share)
        return a->missing_share > b->missing_share;
    return row_a->metric[FM_METRIC_RMSE] > row_b->metric[FM_METRIC_RMSE];
}

static void take_case(fm_stability_cell *cell, const fm_case_row *row)
{
    const fm_blame blame = blame_case(row);
    cell->cases++;
    cell->open += blame_is_open(&blame);
    if (cell->row != NULL && !is_worse(&blame, row, &cell->blame, cell->row))
        return;
    cell->row = row;
    cell->blame = blame;
}

/* Its place among the methods, and among the scenes; each is taken in once. */
static bool place_case(size_t *method, size_t *scene, matrix_axes *axes, const fm_case_row *row)
{
    fm_stability_matrix *matrix = axes->matrix;
    *method = text_index_add(&axes->methods, row->method, matrix->method_count);
    *scene = text_index_add(&axes->scenes, row->scene, matrix->scene_count);
    if (*method == FM_TEXT_INDEX_NONE || *scene == FM_TEXT_INDEX_NONE)
        return false;
    if (*method == matrix->method_count)
        matrix->methods[matrix->method_count++] = row;
    if (*scene == matrix->scene_count)
        matrix->scenes[matrix->scene_count++] = row->scene;
    return true;
}

static bool list_axes(matrix_axes *axes, const fm_result_files *results)
{
    fm_stability_matrix *matrix = axes->matrix;
    size_t method, scene;
    matrix->methods = calloc(results->count + 1, sizeof matrix->methods[0]);
    matrix->scenes = calloc(results->count + 1, sizeof matrix->scenes[0]);
    if (matrix->methods == NULL || matrix->scenes == NULL)
        return false;
    for (size_t i = 0; i < results->count; i++) {
        const fm_case_row *row = &results->cases[i];
        if (is_of(matrix, row) && has_verdict(row) && !place_case(&method, &scene, axes, row))
            return false;
    }
    return true;
}

static bool fill(fm_stability_matrix *matrix, const fm_result_files *results)
{
    matrix_axes axes = { .matrix = matrix };
    size_t method, scene;
    bool is_made = list_axes(&axes, results);
    if (is_made)
        matrix->cells = calloc(matrix->method_count * matrix->scene_count, sizeof matrix->cells[0]);
    is_made = is_made && matrix->cells != NULL;
    for (size_t i = 0; i < results->count && is_made; i++) {
        const fm_case_row *row = &results->cases[i];
        if (!is_of(matrix, row) || !has_verdict(row))
            continue;
        is_made = place_case(&method, &scene, &axes, row);
        if (is_made)
            take_case(&matrix->cells[method * matrix->scene_count + scene], row);
    }
    text_index_free(&axes.methods);
    text_index_free(&axes.scenes);
    return is_made;
}

static void count_cases(fm_stability_matrices *matrices, const fm_stability_matrix *matrix)
{
    for (size_t i = 0; i < matrix->method_count * matrix->scene_count; i++) {
        matrices->cases += matrix->cells[i].cases;
        matrices->open += matrix->cells[i].open;
    }
}

fm_status matrices_make(fm_stability_matrices *matrices, const fm_result_files *results,
                        fm_error *err)
{
    *matrices = (fm_stability_matrices){ 0 };
    bool is_made = find_matrices(matrices, results);
    for (size_t i = 0; i < matrices->count && is_made; i++) {
        is_made = fill(&matrices->items[i], results);
        if (is_made)
            count_cases(matrices, &matrices->items[i]);
    }
    return is_made ? FM_OK : fm_fail(err, FM_NO_MEMORY, "stability of %zu cases", results->count);
}

void matrices_free(fm_stability_matrices *matrices)
{
    for (size_t i = 0; i < matrices->count; i++) {
        free(matrices->items[i].methods);
        free(matrices->items[i].scenes);
        free(matrices->items[i].cells);
    }
    free(matrices->items);
    *matrices = (fm_stability_matrices){ 0 };
}

const fm_stability_cell *matrix_cell(const fm_stability_matrix *matrix, size_t method, size_t scene)
{
    return &matrix->cells[method * matrix->scene_count + scene];
}
