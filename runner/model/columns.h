/* The columns of summary.csv, in their order: one row a case. The parent writes by this table, and
 * reports read by it. New columns come at the end: older readers keep working, and readers take
 * what an older file lacks for empty. */
#ifndef FM_COLUMNS_H
#define FM_COLUMNS_H

#include <stdbool.h>
#include <stddef.h>

#include "metrics.h"

/* Texts of a case that are neither a key nor a metric. */
typedef enum fm_fact {
    FM_FACT_SCHEMA,         /* FM_SUMMARY_SCHEMA */
    FM_FACT_CASE_ID,        /* 16 hex digits */
    FM_FACT_STATUS,         /* case_status_name */
    FM_FACT_MESSAGE,        /* why it is not ok, or what is to be known of it */
    FM_FACT_METHOD,         /* id */
    FM_FACT_METHOD_VERSION, /* of its descriptor */
    FM_FACT_DEVICE,         /* as asked for: "vulkan:0" */
    FM_FACT_DEVICE_NAME,    /* as it calls itself */
    FM_FACT_FEED,           /* feed_name */
    FM_FACT_SCENE,          /* its name, or the path of its file */
    FM_FACT_OPTIONS, /* "key=value ...": all of a method's own, and keys off their default that have
                        no column */
    FM_FACT_CODE_PROGRAM, /* 16 hex digits of what the row was measured by (code/code.h) */
    FM_FACT_CODE_DRIVER,  /* the same; empty: no launch opened the device */
    FM_FACT_CODE_PLUGIN,  /* of the method's plugin and the floor's */
    FM_FACT_CODE_SHADERS, /* of all GLSL that was read; empty: none was */
    FM_FACT_NOISY,        /* why its times are not to be relied on; empty: no reason is known */
    FM_FACT_REASON,       /* case_reason_name of a case that is not_supported; empty: of others,
                             and of older runs */
    FM_FACT_LIMITED_BY,   /* feed, bytes or atomics: what takes the device longest (bound/bound.h);
                             empty: not known */
    FM_FACT_COUNT
} fm_fact;

#define FM_SUMMARY_SCHEMA "1"

typedef enum fm_column_kind {
    FM_COLUMN_FACT,   /* text */
    FM_COLUMN_KEY,    /* a key's value, empty where the scene or method does not use it */
    FM_COLUMN_METRIC, /* a number, empty where it does not apply */
    FM_COLUMN_LOW,    /* lower end of the 95 % interval of a metric; empty: of one launch */
    FM_COLUMN_HIGH    /* upper end of it */
} fm_column_kind;

typedef struct fm_column {
    fm_column_kind kind;
    fm_fact fact;
    const char *name; /* of a key; of an interval's end: the metric's with _low or _high */
    fm_metric metric;
} fm_column;

enum {
    FM_COLUMN_COUNT = 116,
    FM_COLUMN_REQUIRED =
        51 /* the first of them: files of schema 1 have these, later ones may lack */
};
extern const fm_column fm_columns[FM_COLUMN_COUNT];

/* As the first line of summary.csv spells it. */
const char *column_name(const fm_column *column);
/* Whether summary.csv has a column of this name. */
bool summary_has_column(const char *name);

#endif
