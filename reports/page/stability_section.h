/* The part of the report that says how methods did on each scene, and why. */
#ifndef FM_STABILITY_SECTION_H
#define FM_STABILITY_SECTION_H

#include "writer.h"

/* A matrix of methods by scenes for each device and feed, and below it who was wrong, how much and
 * by which trait, and who is not supported. FM_NO_MEMORY. */
fm_status stability_section_add(fm_writer *to);

#endif
