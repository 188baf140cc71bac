/* Limits that a process sets itself before other code runs in it. */
#ifndef FM_LIMITS_H
#define FM_LIMITS_H

#include <stdint.h>

/* 0: as ours. None can be raised over ours. */
typedef struct fm_process_limits {
    uint64_t memory_bytes; /* address space */
    uint64_t file_bytes;   /* of each file that it writes */
    uint32_t cpu_s;        /* then it is killed by SIGXCPU, and a second later by SIGKILL */
    uint32_t open_files;
} fm_process_limits;

/* For this process and all that it starts, for ever; and it dumps no core. */
void limits_set(const fm_process_limits *limits);

#endif
