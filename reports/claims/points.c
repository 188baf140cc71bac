#include "points.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "read/group.h"
#include "read/options.h"
#include "read/workload.h"
#include "seeds.h"

void claim_points_add(fm_claim_points *points, const fm_claim_point *point)
{
    if (points->count == points->capacity) {
        const size_t capacity = points->capacity > 0 ? 2 * points->capacity : 32;
        fm_claim_point *grown = reallocarray(points->points, capacity, sizeof *grown);
        if (grown == NULL) {
            points->failed = true;
            return;
        }
        points->points = grown;
        points->capacity = capacity;
    }
    points->points[points->count++] = *point;
}

void claim_points_lose(fm_claim_points *points, const fm_claim_lost *row)
{
    fm_claim_lost *grown = reallocarray(points->lost, points->lost_count + 1, sizeof *grown);
    if (grown == NULL) {
        points->failed = true;
        return;
    }
    points->lost = grown;
    points->lost[points->lost_count++] = *row;
}

void claim_points_reason(char text[256], const fm_case_row *result, const char *why)
{
    snprintf(text, 256, "%.60s%s%.12g: %.120s",
             result->look.title != NULL ? result->look.title : result->method,
             isnan(result->k) ? " n " : " k ",
             isnan(result->k) ? result->metric[FM_METRIC_N] : result->k, why);
}

void claim_points_free(fm_claim_points *points)
{
    free(points->points);
    free(points->lost);
    *points = (fm_claim_points){ 0 };
}

bool claim_point_same_workload(const fm_claim *claim, const fm_claim_point *a,
                               const fm_claim_point *b)
{
    if (a->result == NULL || b->result == NULL)
        return a->result == b->result;
    const fm_text_list *free_columns =
        claim->form == FM_CLAIM_ORDER ? &claim->of[b->selection].own_columns : &claim->free_columns;
    return seeds_stay_apart(claim) ? workload_same(a->result, b->result, free_columns)
                                   : workload_same_of_any_seed(a->result, b->result, free_columns);
}

bool claim_point_same_series(const fm_claim *claim, const fm_claim_point *a,
                             const fm_claim_point *b)
{
    if (a->selection != b->selection || !claim_point_same_workload(claim, a, b))
        return false;
    return a->result == NULL || claim->of[a->selection].take != FM_TAKE_EACH ||
           (strcmp(a->result->method, b->result->method) == 0 &&
            options_are_same(a->result->options, b->result->options, FM_OPTIONS_OWN,
                             &claim->free_columns));
}

/* An insertion sort, which the few points of a claim allow: "same series" is no order. */
void claim_points_sort(fm_claim_points *points, const fm_claim *claim)
{
    for (size_t i = 1; i < points->count; i++) {
        const fm_claim_point point = points->points[i];
        size_t place = i;
        for (size_t j = 0; j < i; j++)
            if (claim_point_same_series(claim, &points->points[j], &point))
                place = j + 1;
        while (place > 0 && claim_point_same_series(claim, &points->points[place - 1], &point) &&
               points->points[place - 1].x > point.x)
            place--;
        memmove(points->points + place + 1, points->points + place,
                (i - place) * sizeof *points->points);
        points->points[place] = point;
    }
}

void claim_point_name(char name[160], const fm_claim_rows *rows, const bool *used_cases,
                      const fm_claim_point *point)
{
    char title[96];
    if (point->result == NULL) {
        snprintf(name, 160, "%.60s, %.60s",
                 table_cell(rows->memory, point->row, table_column(rows->memory, "title")),
                 table_cell(rows->memory, point->row, table_column(rows->memory, "workload")));
        return;
    }
    group_series_title(title, point->result, NULL);
    const size_t used = (size_t)snprintf(name, 160, "%.80s", title);
    workload_name(name + used, 160 - used, rows->results, used_cases, point->result);
}
