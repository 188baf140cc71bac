/* Fields of a CSV file as RFC 4180 has it. Strict reading is table.h's. */
#ifndef FM_CSV_H
#define FM_CSV_H

#include "text.h"

/* Adds one field, quoted if it holds a comma, a quote or an end of line. Commas between fields and
 * the end of the line are the caller's. */
void csv_add(fm_text *text, const char *field);
/* Adds a number with nine digits, enough for a float; nothing for NAN, "inf" or "-inf" for an
 * infinity. */
void csv_add_real(fm_text *text, double value);

/* Of files that fragmark wrote itself, in place: the field at *at, without its quotes; *at moves
 * behind its comma. Cuts what it passes. */
char *csv_take_field(char **at);
/* The end of the line at `at`: its '\n', or the NUL. */
char *csv_line_end(char *at);

#endif
