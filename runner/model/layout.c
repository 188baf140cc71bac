#include "layout.h"

#include <stdio.h>
#include <string.h>

#include "model/formula.h"

/* Layouts from the fastest on, as measured: DECISIONS.md, 108. */
typedef struct layout_rule {
    bool is_software, is_bounded; /* of the device; of the method: FM_TRAIT_BOUNDED */
    const char *order[4];
} layout_rule;

static const char *const published[] = { "image", "layer" };

static const layout_rule rules[] = {
    { .is_software = false, .is_bounded = true, .order = { "image", "tile", "layer", "pixel" } },
    { .is_software = false, .is_bounded = false, .order = { "tile", "layer", "pixel", "image" } },
    { .is_software = true, .is_bounded = true, .order = { "tile", "pixel", "layer", "image" } },
    { .is_software = true, .is_bounded = false, .order = { "tile", "pixel", "layer", "image" } },
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

bool layout_is_published(const char *option, const char *value)
{
    return strcmp(option, LAYOUT_OPTION) == 0 && strcmp(value, LAYOUT_PUBLISHED) == 0;
}

bool layout_is_open(const fm_choice *choice)
{
    return layout_is_published(choice->name, choice->value) ||
           (strcmp(choice->name, LAYOUT_OPTION) == 0 && strcmp(choice->value, LAYOUT_AUTO) == 0);
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
           rule->is_bounded != ((method->traits & FM_TRAIT_BOUNDED) != 0))
        rule++; /* there is one for each pair */
    return rule;
}

/* The first that the method has and the device takes; else whatever else the method has. */
static void resolve(fm_choice *choice, const asked_choices *asked, const fm_layout_case *of,
                    const fm_layout_device *device)
{
    const fm_option *option = option_find(of->method, choice->name);
    const bool is_published = layout_is_published(choice->name, choice->value);
    const char *const *order = is_published ? published : rule_for(of->method, device)->order;
    const size_t length = is_published ? sizeof published / sizeof published[0] : ORDER_LENGTH;
    for (size_t i = 0; i < length; i++) {
        if (!option_has_value(option, order[i]))
            continue;
        snprintf(choice->value, sizeof choice->value, "%s", order[i]);
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
