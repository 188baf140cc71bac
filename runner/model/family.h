/* Families, markers and traits of methods by the names that manifest.json gives them. */
#ifndef FM_FAMILY_H
#define FM_FAMILY_H

#include "fragmark/method.h"

/* "k-plus-buffer". */
const char *family_name(fm_family family);
/* An unknown name, or NULL, is the family of controls. */
fm_family family_parse(const char *name);
/* "sorted_input", of bit 2 of FM_TRAIT_*; NULL: there is no such bit. */
const char *trait_name(unsigned bit);
/* The same for people: "needs sorted input". */
const char *trait_words(unsigned bit);
/* "square". */
const char *marker_name(fm_marker marker);
/* An unknown name, or NULL, is the circle. */
fm_marker marker_parse(const char *name);

#endif
