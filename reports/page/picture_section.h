/* Pictures of the cases: what was drawn, what was to be drawn, and a heat map of the difference. */
#ifndef FM_PICTURE_SECTION_H
#define FM_PICTURE_SECTION_H

#include "read/group.h"
#include "writer.h"

/* Writes PNG, EXR and heat maps of all pictures that the run kept, and adds the first 64 MiB of
 * them to the page. FM_IO, FM_NO_MEMORY; FM_INVALID: a damaged picture. */
fm_status picture_section_add(fm_writer *to, const fm_groups *groups);

#endif
