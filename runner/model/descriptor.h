/* Questions to a descriptor: how long its lists are, and what is chosen of its options. The
 * descriptor was checked (plugin_check) or is the runner's own; answers point into it. */
#ifndef FM_DESCRIPTOR_H
#define FM_DESCRIPTOR_H

#include <stdbool.h>
#include <stddef.h>

#include "fragmark/method.h"

/* Lengths of the lists, FM_MAX_* at most. */
size_t pass_count(const fm_method_desc *method);
size_t resource_count(const fm_method_desc *method);
size_t total_count(const fm_method_desc *method);
/* Of a pass's reads, or of its writes. */
size_t access_count(const char *const names[FM_MAX_ACCESSES]);

/* What a user chose for one of a method's own options; texts of the command line or a spec. */
typedef struct fm_choice {
    char name[64];  /* of the option */
    char value[64]; /* one of its values, once the plan has checked it */
} fm_choice;

/* The method's option of that name; NULL: it has none. */
const fm_option *option_find(const fm_method_desc *method, const char *name);
/* Whether the option may have this value; values compare as texts. */
bool option_has_value(const fm_option *option, const char *value);
/* The method with the resources that are there under these choices: of each name one, the one whose
 * condition holds (fm_resource.when_option), or else the one without. What was chosen already
 * stays. Borrows from the method. */
void method_choose(fm_method_desc *chosen, const fm_method_desc *method, const fm_choice *choices,
                   size_t choice_count);

/* What is chosen for the method's option: one of `choices`, or its first value; NULL: it has no
 * option of that name. */
const char *option_chosen(const fm_method_desc *method, const char *name, const fm_choice *choices,
                          size_t choice_count);

#endif
