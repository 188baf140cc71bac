/* Which build of a shared library, and of a driver, this process uses. */
#ifndef FM_DEVICE_LIBRARY_H
#define FM_DEVICE_LIBRARY_H

#include "device.h"

/* Writes the build id, as the linker noted it, of the library that holds the address; without one a
 * hash of its file; "" where the address lies in no library. */
void library_build(char *build, size_t room_bytes, uintptr_t address);

/* What tells an open device and its driver's build from all others; of devices that are a part of
 * the program, the program's hash. */
uint64_t device_build_hash(const fm_device_caps *caps, uint64_t program);

#endif
