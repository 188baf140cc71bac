/* Pieces of HTML. Out of memory is remembered in the page's `failed`. */
#ifndef FM_HTML_H
#define FM_HTML_H

#include <stddef.h>

#include "base/error.h"
#include "base/text.h"

/* Adds text with <, >, &, " and ' escaped. */
void html_add(fm_text *page, const char *text);
/* Adds <img> with a PNG file inside. FM_IO, FM_NO_MEMORY. */
fm_status html_add_png(fm_text *page, const char *path, const char *alternative, fm_error *err);
/* Adds a table cell with a number of so many digits, empty when it is NAN; tables sort by it. */
void html_add_number(fm_text *page, int digits, double value);

#endif
