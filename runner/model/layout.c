#include "layout.h"

#include <stdio.h>
#include <string.h>

#include "model/formula.h"

/* Layouts from the fastest on, as measured: DECISIONS.md, 108 and 114. The first rule that fits. */
typedef struct layout_rule {
    bool is_software;    /* of the device */
    uint32_t has, lacks; /* of the method: FM_TRAIT_* */
    const char *order[4];
} layout_rule;

static const layout_rule rules[] = {
    { .has = FM_TRAIT_BOUNDED, .order = { "image", "tile", "layer", "pixel" } },
    { .is_software = false, .order = { "tile", "layer", "pixel", "image" } },
    { .is_software = true,
      .has = FM_TRAIT_BOUNDED,
      .lacks = FM_TRAIT_SORTS_IN_RESOLVE, /* walks along a pixel's slots for each fragment */
      .order = { "pixel", "tile", "layer", "image" } },
    { .is_software = true, .order = { "tile", "pixel", "layer", "image" } },
};
enum { ORDER_LENGTH = sizeof rules[0].order / sizeof rules[0].order[0] };

fm_layout_case layout_case(const fm_method_desc *method, const fm_settings *settings, uint32_t n)
{
    return (fm_layout_case){ .method = method,
                             .width_px = settings->width_px,
                             .height_px = settings->height_px,
                             .k = settings->k,
                             .n = n,
                             .needs_buffers = settings->culling == FM_CULLING_OCCUPANCY &&
                                              settings->cull_memory == FM_CULL_MEMORY_SHARED };
}

bool layout_is_open(const fm_choice *choice)
{
    return strcmp(choice->name, LAYOUT_OPTION) == 0 && strcmp(choice->value, LAYOUT_AUTO) == 0;
}

/* What formulas ask: the workload's runner. */
typedef struct asked_choices {
    const fm_method_desc *method;
    const fm_choice *choices;
    size_t count;
} asked_choices;

static const char *chosen_of(const fm_workload *workload, const char *name)
{
    const asked_choices *asked = workload->runner;
    return option_chosen(asked->method, name, asked->choices, asked->count);
}

/* Whether the device has the images that the method asks for. */
static bool fits(const asked_choices *asked, const fm_layout_case *of,
                 const fm_layout_device *device)
{
    fm_method_desc chosen;
    const fm_workload workload = { .width_px = of->width_px,
                                   .height_px = of->height_px,
                                   .k = of->k,
                                   .n = of->n,
                                   .option = chosen_of,
                                   .runner = asked };
    method_choose(&chosen, asked->method, asked->choices, asked->count);
    for (size_t i = 0; i < resource_count(&chosen); i++) {
        const fm_resource *resource = &chosen.resources[i];
        if (resource->kind == FM_RESOURCE_IMAGE && resource->when_option != NULL &&
            (of->needs_buffers || formula_layers(resource, &workload) > device->image_layers ||
             formula_image_bytes(resource, &workload) > device->image_max_bytes))
            return false;
    }
    return true;
}

static const layout_rule *rule_for(const fm_method_desc *method, const fm_layout_device *device)
{
    const layout_rule *rule = rules;
    while (rule->is_software != device->is_software ||
           (method->traits & (rule->has | rule->lacks)) != rule->has)
        rule++; /* the last one of each device asks for no trait */
    return rule;
}

/* The first that the method has and the device takes; else whatever else the method has. */
static void resolve(fm_choice *choice, const asked_choices *asked, const fm_layout_case *of,
                    const fm_layout_device *device)
{
    const fm_option *option = option_find(of->method, choice->name);
    const layout_rule *rule = rule_for(of->method, device);
    for (size_t i = 0; i < ORDER_LENGTH; i++) {
        if (!option_has_value(option, rule->order[i]))
            continue;
        snprintf(choice->value, sizeof choice->value, "%s", rule->order[i]);
        if (fits(asked, of, device))
            return;
    }
    for (size_t i = 0; i < FM_MAX_OPTION_VALUES && option->values[i] != NULL; i++)
        if (strcmp(option->values[i], LAYOUT_AUTO) != 0) {
            snprintf(choice->value, sizeof choice->value, "%s", option->values[i]);
            return;
        }
}

void layout_resolve(fm_choice *choices, size_t count, const fm_layout_case *of,
                    const fm_layout_device *device)
{
    const asked_choices asked = { of->method, choices, count };
    for (size_t i = 0; i < count; i++)
        if (layout_is_open(&choices[i]))
            resolve(&choices[i], &asked, of, device);
}

size_t layout_choices(fm_choice all[FM_MAX_OPTIONS], const fm_choice *given, size_t given_count,
                      const fm_layout_case *of, const fm_layout_device *device)
{
    size_t count = 0;
    for (; count < FM_MAX_OPTIONS && of->method->options[count].name != NULL; count++) {
        const char *name = of->method->options[count].name;
        snprintf(all[count].name, sizeof all[count].name, "%s", name);
        snprintf(all[count].value, sizeof all[count].value, "%s",
                 option_chosen(of->method, name, given, given_count));
    }
    layout_resolve(all, count, of, device);
    return count;
}
