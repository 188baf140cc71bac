/* Facts of this machine that numbers depend on. */
#ifndef FM_MACHINE_H
#define FM_MACHINE_H

#include <stdint.h>

/* Texts are "unknown" where the system does not tell. */
typedef struct fm_machine {
    char cpu[128];
    char os[128];       /* "Debian GNU/Linux 12 (bookworm)" */
    char kernel[128];   /* "Linux 6.1.0-18-amd64 x86_64" */
    char compiler[128]; /* that built this program */
    char governor[64];  /* of CPU frequency: anything but "performance" makes times drift */
    uint32_t cores;     /* that this process may use */
    uint64_t memory_bytes;
} fm_machine;

void machine_describe(fm_machine *machine);

#endif
