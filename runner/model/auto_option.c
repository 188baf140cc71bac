#include "auto_option.h"

#include <stdio.h>
#include <string.h>

#include "model/formula.h"

#define LAYOUT    "layout"
#define PUBLISHED "published"
#define NODE      "node"
#define PIXELS    "per_pixel"

const fm_auto_option auto_options[AUTO_OPTION_COUNT] = { { LAYOUT, "" },
                                                         { NODE, "split" },
                                                         { PIXELS, "rows" } };

/* An option's values from the fastest on, as measured: DECISIONS.md, 108, 110, 111 and 114. The
 * first rule of an option that is for the device and for the method counts. */
typedef struct auto_rule {
    const char *option;
    bool is_software;    /* the device */
    uint32_t has, lacks; /* traits of the method */
    const char *order[4];
} auto_rule;

static const auto_rule rules[] = {
    { LAYOUT, false, FM_TRAIT_BOUNDED, 0, { "image", "tile", "layer", "pixel" } },
    { LAYOUT, false, 0, 0, { "tile", "layer", "pixel", "image" } },
    /* it walks along a pixel's slots for each fragment */
    { LAYOUT,
      true,
      FM_TRAIT_BOUNDED,
      FM_TRAIT_SORTS_IN_RESOLVE,
      { "pixel", "tile", "layer", "image" } },
    { LAYOUT, true, 0, 0, { "tile", "pixel", "layer", "image" } },
    { NODE, false, 0, 0, { "whole", "split" } },
    { NODE, true, 0, 0, { "split", "whole" } },
    { PIXELS, false, 0, 0, { "rows", "tiles", "images" } },
    { PIXELS, true, 0, 0, { "images", "rows", "tiles" } },
};
enum { ORDER_LENGTH = sizeof rules[0].order / sizeof rules[0].order[0] };

static const char *const published[ORDER_LENGTH] = { "image", "layer" };

fm_auto_case auto_case(const fm_method_desc *method, const fm_settings *settings, uint32_t n)
{
    return (fm_auto_case){ .method = method,
                           .width_px = settings->width_px,
                           .height_px = settings->height_px,
                           .k = settings->k,
                           .n = n,
                           .needs_buffers = settings->culling == FM_CULLING_OCCUPANCY &&
                                            settings->cull_memory == FM_CULL_MEMORY_SHARED };
}

bool auto_is_published(const char *option, const char *value)
{
    return strcmp(option, LAYOUT) == 0 && strcmp(value, PUBLISHED) == 0;
}

bool auto_is_open(const fm_choice *choice)
{
    if (auto_is_published(choice->name, choice->value))
        return true;
    for (size_t i = 0; i < AUTO_OPTION_COUNT; i++)
        if (strcmp(choice->name, auto_options[i].name) == 0)
            return strcmp(choice->value, AUTO_VALUE) == 0;
    return false;
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
static bool fits(const asked_choices *asked, const fm_auto_case *of, const fm_auto_device *device)
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

static const auto_rule *rule_for(const char *option, const fm_method_desc *method,
                                 const fm_auto_device *device)
{
    const auto_rule *rule = rules;
    while (strcmp(rule->option, option) != 0 || rule->is_software != device->is_software ||
           (method->traits & (rule->has | rule->lacks)) != rule->has)
        rule++; /* each option has one without traits for both kinds of devices */
    return rule;
}

/* The first that the method has and the device takes; else whatever else the method has. */
static void resolve(fm_choice *choice, const asked_choices *asked, const fm_auto_case *of,
                    const fm_auto_device *device)
{
    const fm_option *option = option_find(of->method, choice->name);
    const char *const *order = auto_is_published(choice->name, choice->value)
                                   ? published
                                   : rule_for(choice->name, of->method, device)->order;
    for (size_t i = 0; i < ORDER_LENGTH && order[i] != NULL; i++) {
        if (!option_has_value(option, order[i]))
            continue;
        snprintf(choice->value, sizeof choice->value, "%s", order[i]);
        if (fits(asked, of, device))
            return;
    }
    for (size_t i = 0; i < FM_MAX_OPTION_VALUES && option->values[i] != NULL; i++)
        if (strcmp(option->values[i], AUTO_VALUE) != 0) {
            snprintf(choice->value, sizeof choice->value, "%s", option->values[i]);
            return;
        }
}

void auto_resolve(fm_choice *choices, size_t count, const fm_auto_case *of,
                  const fm_auto_device *device)
{
    const asked_choices asked = { of->method, choices, count };
    for (size_t i = 0; i < count; i++)
        if (auto_is_open(&choices[i]))
            resolve(&choices[i], &asked, of, device);
}

size_t auto_choices(fm_choice all[FM_MAX_OPTIONS], const fm_choice *given, size_t given_count,
                    const fm_auto_case *of, const fm_auto_device *device)
{
    size_t count = 0;
    for (; count < FM_MAX_OPTIONS && of->method->options[count].name != NULL; count++) {
        const char *name = of->method->options[count].name;
        snprintf(all[count].name, sizeof all[count].name, "%s", name);
        snprintf(all[count].value, sizeof all[count].value, "%s",
                 option_chosen(of->method, name, given, given_count));
    }
    auto_resolve(all, count, of, device);
    return count;
}
