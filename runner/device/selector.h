/* The part of a device's name behind the colon: "vulkan:1", "vulkan:llvmpipe". */
#ifndef FM_DEVICE_SELECTOR_H
#define FM_DEVICE_SELECTOR_H

#include <stdbool.h>
#include <stddef.h>

/* Whether a selector means this one of the devices that a driver lists.
 * selector  an index, in decimal digits, or a part of a name in upper or lower case; NULL and ""
 *           mean any device. Borrowed.
 * index     where the device stands in the driver's list, from 0
 * name      what the driver calls it: "llvmpipe (LLVM 15.0.6, 256 bits)". Borrowed.
 * "1" is always an index, also where a name has a 1 in it. */
bool selector_matches(const char *selector, size_t index, const char *name);

#endif
