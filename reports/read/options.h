/* Options of a case: the text "key=value key=value" that summary.csv holds in one cell. Keys of the
 * scene and of the picture (exposure) among them belong to the workload; all others are the
 * method's own. */
#ifndef FM_READ_OPTIONS_H
#define FM_READ_OPTIONS_H

#include <stdbool.h>

#include "base/text.h"

enum { FM_OPTIONS_TEXT_BYTES = 256, FM_OPTION_VALUE_BYTES = 128 };

typedef enum fm_options_sort { FM_OPTIONS_OWN, FM_OPTIONS_OF_SCENE } fm_options_sort;

/* The value of a key; "" when it is not there. A longer one is cut. */
void options_value(char value[FM_OPTION_VALUE_BYTES], const char *options, const char *key);

/* Whether two cases have the same options of one sort, in the same order, but for the keys that
 * `without` names, which may be NULL. */
bool options_are_same(const char *a, const char *b, fm_options_sort sort,
                      const fm_text_list *without);

/* Those options alone that are not in `defaults`, a text of the same form. NULL: none is a default.
 */
void options_drop(char kept[FM_OPTIONS_TEXT_BYTES], const char *options, const char *defaults);

/* Those options alone, with blanks between them; options that no longer fit are left out. */
void options_select(char chosen[FM_OPTIONS_TEXT_BYTES], const char *options, fm_options_sort sort,
                    const fm_text_list *without);

#endif
