/* Which build of a shared library this process uses. For implementations of devices. */
#ifndef FM_DEVICE_LIBRARY_H
#define FM_DEVICE_LIBRARY_H

#include <stddef.h>
#include <stdint.h>

/* Writes the build id, as the linker noted it, of the library that holds the address; without one a
 * hash of its file; "" where the address lies in no library. */
void library_build(char *build, size_t room_bytes, uintptr_t address);

#endif
