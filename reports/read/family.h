/* Families and markers by the names that manifest.json gives them. */
#ifndef FM_READ_FAMILY_H
#define FM_READ_FAMILY_H

#include "fragmark/method.h"

/* "k-plus-buffer". */
const char *family_name(fm_family family);
/* An unknown name, or NULL, is the family of controls. */
fm_family family_parse(const char *name);
/* "square". An unknown name, or NULL, is the circle. */
fm_marker marker_parse(const char *name);

#endif
