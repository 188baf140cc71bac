/* What is known of each format of an image and each element of a buffer: one table of each. */
#ifndef FM_FORMATS_H
#define FM_FORMATS_H

#include <stdbool.h>

#include "fragmark/method.h"

/* Bytes of one texel and sample as memory books them: 5 for FM_FORMAT_D32F_S8, whatever a device
 * pads it to; 0 for FM_FORMAT_NONE. */
uint32_t format_bytes(fm_format format);
/* Whether it is tested and written as depth; such images are no colour targets. */
bool format_has_depth(fm_format format);
/* Whether its texels are unsigned integers: such images neither blend nor filter. */
bool format_is_integer(fm_format format);
/* Bytes of one element of a buffer: its stride in std430. */
uint32_t element_bytes(fm_element element);

#endif
