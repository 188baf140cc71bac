/* Which error is held against time. */
#ifndef FM_ERROR_KIND_H
#define FM_ERROR_KIND_H

#include "read/cases.h"

typedef struct fm_error_kind {
    fm_metric metric;
    /* Errors up to this are rounding: the picture is exact. FLIP and the like magnify rounding. */
    double exact_below;
    bool is_exposed; /* exposure=E scales the error, and so its rounding, by 2^E */
    fm_metric
        worst; /* the same of the worst frame, where frames differ; FM_METRIC_COUNT: none is */
} fm_error_kind;

/* The kind of that name: a metric of an image's error, such as total_flip. NULL: total_rmse, the
 * default. Returns NULL if there is none, with the nearest in *nearest. */
const fm_error_kind *error_kind_find(const char *name, const char **nearest);

/* The kind of that metric; NULL: it is no error that is held against time. */
const fm_error_kind *error_kind_by_metric(fm_metric metric);

/* A case's error, 0 where it is exact; of a similarity (ssim) what is missing to 1. Of frames that
 * differ the worst, where that is measured. NAN: none. */
double error_kind_of(const fm_error_kind *kind, const fm_case_row *result);

#endif
