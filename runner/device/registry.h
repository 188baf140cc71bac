/* The devices of a program, looked up by name.
 *
 * No device is known here. A program writes one list of those that it has (fragmark: devices.c)
 * and hands it down to whatever looks devices up; a test may hand down a list of its own. In all
 * functions below the list is borrowed for the call.
 *
 * A name is that of a list's entry, and where one driver offers several devices a colon and a
 * selector (selector.h) may follow: "vulkan", "vulkan:1", "vulkan:llvmpipe", "osmesa",
 * "dummy:tiny".
 */
#ifndef FM_DEVICE_REGISTRY_H
#define FM_DEVICE_REGISTRY_H

#include "device.h"

/* Zero: no devices. */
typedef struct fm_device_list {
    const fm_device_ops *const *devices; /* [count], each with a name of its own; constants */
    size_t count;                        /* any */
} fm_device_list;

/* The entry that a name begins with, up to its colon; NULL: the list has none. */
const fm_device_ops *device_find(const fm_device_list *list, const char *name);

/* The name of the entry that is nearest in spelling, for messages; NULL: none is near. It lives as
 * long as the entry. */
const char *device_nearest(const fm_device_list *list, const char *name);

/* The feeds that a device takes, as FM_FEED_* bits, with its default put in. Never 0. */
uint32_t device_feeds(const fm_device_ops *ops);

/* Whether this machine has the device that a name selects, without opening it.
 * FM_INVALID, naming those that there are: "vulkan:7" is not among the devices of its driver.
 * FM_OK: it is, or nothing can be said: no selector, no such entry, no driver. */
fm_status device_expect(const fm_device_list *list, const char *name, fm_error *err);

/* Opens the device of a name. desc->selector is not read: the selector comes from the name.
 * FM_OK: the caller owns *device, and ends it with device_close.
 * FM_INVALID: no such entry, with the nearest name; or what the device says of its selector.
 * FM_UNSUPPORTED, FM_NO_MEMORY, ...: as fm_device_ops.open. On failure *device is NULL. */
fm_status device_open(fm_device **device, const fm_device_list *list, const char *name,
                      const fm_device_desc *desc, fm_error *err);

/* Ends a device, whose buffers, images and pipelines have been destroyed before. NULL is ignored.
 */
void device_close(fm_device *device);

#endif
