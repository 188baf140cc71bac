/* Methods that are techniques of the simulated GPU. */
#ifndef FM_TECHNIQUE_H
#define FM_TECHNIQUE_H

#include "fragmark/technique.h"
#include "model/descriptor.h"

/* FM_PART_*: what the technique of a checked method asks for, with what these choices add. Options
 * that are not chosen have their first value. */
uint32_t technique_parts(const fm_method_desc *method, const fm_choice *choices, size_t count);

#endif
