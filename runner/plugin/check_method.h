/* The parts of plugin_check. Each checks one list of a descriptor, once: after that nobody checks
 * it again. Messages begin with the field; callers put pass and plugin before it. */
#ifndef FM_CHECK_METHOD_H
#define FM_CHECK_METHOD_H

#include "check_words.h"

/* A descriptor whose lists were counted: nothing after that looks for their ends. */
typedef struct fm_checked_method {
    const fm_method_desc *method;
    fm_known_names options, resources, totals, passes;
} fm_checked_method;

fm_status check_options(const fm_checked_method *check, fm_error *err);
fm_status check_resources(const fm_checked_method *check, fm_error *err);
/* Refused: another resource takes the place of `name`, under an option; what `field` names is
 * always the same one. */
fm_status check_unconditional(const fm_checked_method *check, const char *name, const char *field,
                              fm_error *err);
/* Traits that resources contradict. */
fm_status check_multisampled(const fm_checked_method *check, fm_error *err);
fm_status check_totals(const fm_checked_method *check, fm_error *err);
fm_status check_passes(const fm_checked_method *check, fm_error *err);
fm_status check_loops(const fm_checked_method *check, fm_error *err);
/* For methods of the simulated GPU, instead of resources, totals, passes and loops. */
fm_status check_technique(const fm_checked_method *check, fm_error *err);

/* Targets and state of one pass, of a kind that draws. */
fm_status check_attachments(const fm_checked_method *check, const fm_pass *pass, fm_error *err);
/* Refused unless `name` is an option all of whose values are whole numbers. */
fm_status check_counting_option(const fm_checked_method *check, const char *name, const char *field,
                                fm_error *err);

#endif
