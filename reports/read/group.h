/* Cases that may stand in one chart: same scene, workload, device and feed, but for the columns
 * that the chart leaves free. */
#ifndef FM_GROUP_H
#define FM_GROUP_H

#include "base/text.h"
#include "result_files.h"

typedef struct fm_group {
    const fm_case_row **cases; /* by family, method, options, k; controls last; owned */
    size_t count, room;
    size_t next_alike;  /* the next group whose key is the same (workload_key); SIZE_MAX: none */
    size_t same_names;  /* groups behind it whose texts make the same name */
    char name[128];     /* of the group in file names: "layers-vulkan-raster", unique in a list */
    char title[192];    /* "layers, vulkan: llvmpipe, raster" */
    char workload[200]; /* "854 x 480 pixels, n = 128, pixel density 0.25, ..." */
} fm_group;

typedef struct fm_groups {
    fm_group *groups; /* in the order of their first cases; owned */
    size_t count;
} fm_groups;

/* Whether to take a case. */
typedef bool (*fm_case_filter)(const fm_case_row *result, const void *context);

typedef struct fm_groups_desc {
    fm_case_filter filter; /* which cases to take; NULL: all */
    const void *context;   /* of the filter */
    /* The columns in which cases of a group may differ, beside k; borrowed; NULL: none. */
    const fm_text_list *free_columns;
} fm_groups_desc;

/* Parts the cases of the results, which must outlive the groups. FM_NO_MEMORY; the groups are then
 * empty. The caller frees them. */
fm_status groups_make(fm_groups *groups, const fm_result_files *results, const fm_groups_desc *desc,
                      fm_error *err);
void groups_free(fm_groups *groups);

/* "K+B-Array", with the options that are not the method's defaults, but for those of `without`,
 * which may be NULL. */
void group_series_title(char title[96], const fm_case_row *result, const fm_text_list *without);
/* Procedural scenes with the printed properties of models that the papers do not share. */
bool group_is_stand_in(const char *scene);
/* Same method and options of its own: points of one line, over k. */
bool group_same_series(const fm_case_row *a, const fm_case_row *b);
/* Whether k matters: the method has several k, or the group has only one. */
bool group_uses_k(const fm_group *group, const fm_case_row *result);

#endif
