/* Files that somebody else's code leaves open in this process, until nothing can be opened. */
#ifndef FM_OPEN_FILES_H
#define FM_OPEN_FILES_H

#include <stdint.h>

typedef struct fm_open_files {
    int reserve; /* kept open, so that there is one to open when all others are taken; -1: none */
    uint32_t before;
} fm_open_files;

/* Counts what is open now. */
void open_files_begin(fm_open_files *files);
/* How many more are open since, if they are more than a driver may keep: 200, or half of what the
 * process may open; else 0, or if it cannot be told. Gives the reserve back. Once. */
uint32_t open_files_left(fm_open_files *files);

#endif
