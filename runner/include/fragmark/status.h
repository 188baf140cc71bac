/* What a fragmark function can answer. Plugins get it through method.h: none of their hooks returns
 * it today, but messages about a plugin name it. A function that does not return FM_OK says why in
 * an error that its caller owns. Compare with the names: the numbers behind them may change with
 * the ABI. */
#ifndef FRAGMARK_STATUS_H
#define FRAGMARK_STATUS_H

/* Zero is success; all others are reasons. */
typedef enum fm_status {
    FM_OK,          /* done */
    FM_INVALID,     /* bad input: arguments, files, descriptors */
    FM_UNSUPPORTED, /* this device, or this build, cannot do it: a result, not a failure */
    FM_NO_MEMORY,   /* the host or the device has no room */
    FM_IO,          /* a file cannot be read or written */
    FM_SHADER,      /* a shader does not compile or link */
    FM_DEVICE_LOST, /* the driver gave up; the device is of no use from here on */
    FM_STATUS_COUNT /* how many there are; no status */
} fm_status;

#endif
