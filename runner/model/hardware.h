/* Which machine: what milliseconds hang on, and kernels, drivers and commits do not change. */
#ifndef FM_HARDWARE_H
#define FM_HARDWARE_H

#include <stdbool.h>

/* Texts are borrowed. Two equal machines of a cloud are one. */
typedef struct fm_hardware {
    const char *cpu, *cores; /* "": not told */
    double memory_bytes;     /* NAN: not told */
} fm_hardware;

/* All of it is told. */
bool hardware_is_known(const fm_hardware *hardware);
/* Known, and the same: memory within 2 %, which kernels count differently from boot to boot. */
bool hardware_is_same(const fm_hardware *a, const fm_hardware *b);

/* Eight hex digits that stand for the hardware, which is known. Of two that are the same, memory
 * within 2 %, they may differ: who keeps machines looks for one that is the same first. */
enum { FM_FINGERPRINT_BYTES = 9 };
void hardware_fingerprint(char fingerprint[FM_FINGERPRINT_BYTES], const fm_hardware *hardware);

#endif
