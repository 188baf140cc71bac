/* Questions to a descriptor: how long its lists are, and what is chosen of its options. */
#ifndef FM_DESCRIPTOR_H
#define FM_DESCRIPTOR_H

#include <stdbool.h>
#include <stddef.h>

#include "fragmark/method.h"

size_t pass_count(const fm_method_desc *method);
size_t resource_count(const fm_method_desc *method);
size_t total_count(const fm_method_desc *method);
size_t access_count(const char *const names[FM_MAX_ACCESSES]); /* of reads or writes */

/* One chosen value of a method's own option. */
typedef struct fm_choice {
    char name[64], value[64];
} fm_choice;

/* The method's option of that name, or NULL. */
const fm_option *option_find(const fm_method_desc *method, const char *name);
bool option_has_value(const fm_option *option, const char *value);
/* What is chosen for the method's option: one of `choices`, or its first value; NULL: it has no
 * option of that name. */
const char *option_chosen(const fm_method_desc *method, const char *name, const fm_choice *choices,
                          size_t choice_count);

#endif
