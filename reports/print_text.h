/* What a command prints when it is done. */
#ifndef FM_PRINT_TEXT_H
#define FM_PRINT_TEXT_H

#include "base/text.h"

/* Prints a text that was made with this status, if it is FM_OK, and frees it in any case. Returns
 * the status; or FM_NO_MEMORY: the text failed; FM_IO: not all of it could be written. */
fm_status print_text(fm_text *text, fm_status status, fm_error *err);

#endif
