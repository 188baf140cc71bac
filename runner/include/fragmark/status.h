/* What a fragmark function can answer. Included by plugins through method.h. */
#ifndef FRAGMARK_STATUS_H
#define FRAGMARK_STATUS_H

typedef enum fm_status {
    FM_OK,
    FM_INVALID,     /* bad input: arguments, files, descriptors */
    FM_UNSUPPORTED, /* this device, or this build, cannot do it: a result, not a failure */
    FM_NO_MEMORY,
    FM_IO,
    FM_SHADER,      /* a shader does not compile or link */
    FM_DEVICE_LOST, /* the driver gave up */
    FM_STATUS_COUNT
} fm_status;

#endif
