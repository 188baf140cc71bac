/* A plan of two cases of two launches, and a folder for its results: what targets of the parent
 * hand over to. The cases are those of corpus/journal. */
#ifndef FM_FUZZ_PARENT_KIT_H
#define FM_FUZZ_PARENT_KIT_H

#include "results/results.h"

enum { KIT_CASES = 2, KIT_LAUNCHES = 2, KIT_FRAMES = 2 };
#define KIT_PLAN_HASH "ac2562cac36ebfc7"

typedef struct parent_kit {
    char folder[64];
    fm_case cases[KIT_CASES];
    fm_plan plan;
    fm_plugin_list plugins; /* none */
    fm_results *results;
} parent_kit;

void parent_kit_open(parent_kit *kit);
void parent_kit_close(parent_kit *kit);

#endif
