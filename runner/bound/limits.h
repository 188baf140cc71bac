/* What a device can do at most, as it was measured once and is kept.
 *
 * The room bound holds these numbers, their file, and what follows from them for a case (bound.h).
 * It opens no device: calibrate/ measures. */
#ifndef FM_BOUND_LIMITS_H
#define FM_BOUND_LIMITS_H

#include <jansson.h>
#include <stdint.h>

#include "base/path.h"
#include "base/stats.h"

typedef enum fm_limit {
    FM_LIMIT_COPY,          /* bytes/s read and written: large buffers are copied */
    FM_LIMIT_ATOMICS_OWN,   /* atomics/s, 32 bits: a word for each invocation */
    FM_LIMIT_ATOMICS_GROUP, /* a word for 32 neighbouring invocations */
    FM_LIMIT_ATOMICS_ONE,   /* one word for all */
    FM_LIMIT_ATOMICS64_OWN, /* the same with 64 bits */
    FM_LIMIT_ATOMICS64_GROUP,
    FM_LIMIT_ATOMICS64_ONE,
    FM_LIMIT_DISPATCH, /* ns of a compute pass that does nothing */
    FM_LIMIT_TIMER,    /* ns of a timed interval of nothing */
    FM_LIMIT_RASTER,   /* fragments/s of the floor, method null, on flat layers */
    FM_LIMIT_COUNT
} fm_limit;

typedef struct fm_limit_info {
    const char *name;  /* in files and JSON */
    const char *title; /* for people */
    const char *unit;  /* of the number in files and JSON: "B/s" */
} fm_limit_info;
extern const fm_limit_info fm_limits[FM_LIMIT_COUNT];

/* Which device it is: a software device is as fast as the processors that it runs on. */
typedef struct fm_limits_key {
    char device_name[128]; /* as fm_device_caps has it, as the next */
    char driver[128];
    char cpu[128]; /* of the host */
    uint32_t cores;
} fm_limits_key;

/* One device. */
typedef struct fm_device_limits {
    fm_limits_key key;
    fm_interval values[FM_LIMIT_COUNT]; /* above 0; all NAN: not measured */
} fm_device_limits;

typedef struct fm_limits_list {
    fm_device_limits *items; /* [count], each of another key; owned */
    size_t count;
} fm_limits_list;

/* NULL: this device was not measured. */
const fm_device_limits *limits_find(const fm_limits_list *list, const fm_limits_key *key);
/* Takes the place of what the list has of that key. FM_NO_MEMORY. */
fm_status limits_keep(fm_limits_list *list, const fm_device_limits *limits, fm_error *err);
void limits_free(fm_limits_list *list);

/* limits_file.c. The file of the state folder (base/state.h), and no folder is made. */
fm_status limits_path(char path[FM_PATH_MAX_BYTES], fm_error *err);
/* A file that is not there has no device. FM_INVALID, with the file, and the line or the device:
 * damaged, or of another schema. FM_IO. The list is to be freed, and empty after a failure. */
fm_status limits_read(fm_limits_list *list, const char *path, fm_error *err);
/* With the folder it lies in. FM_IO, FM_INVALID, FM_NO_MEMORY. */
fm_status limits_write(const char *path, const fm_limits_list *list, fm_error *err);
/* One device as the file has it, for json_decref; NULL: no memory. */
json_t *limits_json(const fm_device_limits *limits);

#endif
