/* BASE and NEW: what names them, and which cases both have. */
#ifndef FM_AB_SIDES_H
#define FM_AB_SIDES_H

#include "plan/plan.h"

typedef enum ab_side_name { AB_BASE, AB_NEW, AB_SIDE_COUNT } ab_side_name;
extern const char *const ab_side_names[AB_SIDE_COUNT]; /* "base", "new" */

/* Parts "METHOD@DIR" at its first '@'; method has room for 64 bytes. FM_INVALID: no '@', or nothing
 * on one side of it. */
fm_status side_parse(char method[64], const char **directory, const char *text, fm_error *err);
/* FM_INVALID: the list did not take this method from this folder: the nearest that it has. */
fm_status side_expect(const fm_plugin_list *plugins, const char *folder, const char *method,
                      fm_error *err);
/* Adds the ids of the methods in this folder that the list took from it, but for controls, in the
 * order of the list. Refused ones are among them. FM_NO_MEMORY, or why plugins cannot be read. */
fm_status side_methods(fm_text_list *ids, const fm_plugin_list *plugins, const char *folder,
                       fm_error *err);

/* Leaves of both plans the cases that have one of these ids on either side, with their partners,
 * before they are joined. FM_INVALID: no case has one of the ids; FM_NO_MEMORY. */
fm_status sides_choose(fm_plan *base, fm_plan *now, const fm_text_list *ids, fm_error *err);

/* The same case in both plans, by index. */
typedef struct ab_pair {
    size_t at[AB_SIDE_COUNT];
} ab_pair;

typedef struct ab_pairs {
    ab_pair *items; /* [count], in the order of BASE's plan; owned */
    size_t count;
    size_t unpaired; /* cases of one side alone, which are not launched */
    size_t refused;  /* cases that neither side can run: they are no pairs */
} ab_pairs;

/* Joins cases by what they were asked for: method, scene, device, feed, keys and options. Their
 * versions, and so their ids, may differ. Where each plan has one method, the two may be different
 * ones. Cases without a partner, and those whose partner is not launched, get a reason to be
 * skipped, so that nothing measures them in vain; a pair that only one side refuses stays a pair.
 * One row of a method that NEW refuses as a whole stands for all cases that BASE has of it.
 * FM_INVALID: no case that either can run; FM_NO_MEMORY. The caller frees. */
fm_status sides_join(ab_pairs *pairs, fm_plan *base, fm_plan *now, fm_error *err);
void sides_free(ab_pairs *pairs);

/* "kplus-heap k=8 n=16 layers vulkan raster layout=pixel": method, k, n, axes that were given. */
void side_case_name(fm_text *name, const fm_case *planned);

#endif
