/* A selection with every name looked up and every axis judged. */
#ifndef FM_CHOSEN_H
#define FM_CHOSEN_H

#include "plan.h"
#include "selection.h"

typedef struct fm_chosen_scene {
    char name[sizeof((fm_case *)NULL)->scene];
    fm_settings settings; /* of its file; not finished */
} fm_chosen_scene;

/* The counts of scenes and devices are those of their names in the selection. */
typedef struct fm_chosen {
    fm_selection selection; /* lists that were left open hold their defaults */
    fm_plugin_entry **methods;
    size_t method_count;
    fm_chosen_scene *scenes;
    const fm_device_ops **devices;
} fm_chosen;

/* FM_INVALID, with where it was written and the nearest legal name: unknown methods, scenes,
 * devices, feeds, keys, options, values; several values of a run's key; keys that no chosen scene
 * reads. */
fm_status chosen_create(fm_chosen *chosen, const fm_plan_request *request,
                        const fm_plugin_list *plugins, fm_error *err);
void chosen_destroy(fm_chosen *chosen);

#endif
