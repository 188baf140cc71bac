#include "descriptor.h"

#include <string.h>

size_t pass_count(const fm_method_desc *method)
{
    size_t count = 0;
    while (count < FM_MAX_PASSES && method->passes[count].name != NULL)
        count++;
    return count;
}

size_t resource_count(const fm_method_desc *method)
{
    size_t count = 0;
    while (count < FM_MAX_RESOURCES && method->resources[count].name != NULL)
        count++;
    return count;
}

size_t total_count(const fm_method_desc *method)
{
    size_t count = 0;
    while (count < FM_MAX_TOTALS && method->totals[count].name != NULL)
        count++;
    return count;
}

size_t access_count(const char *const names[FM_MAX_ACCESSES])
{
    size_t count = 0;
    while (count < FM_MAX_ACCESSES && names[count] != NULL)
        count++;
    return count;
}

const fm_option *option_find(const fm_method_desc *method, const char *name)
{
    for (size_t i = 0; i < FM_MAX_OPTIONS && method->options[i].name != NULL; i++)
        if (strcmp(method->options[i].name, name) == 0)
            return &method->options[i];
    return NULL;
}

const char *option_chosen(const fm_method_desc *method, const char *name, const fm_choice *choices,
                          size_t choice_count)
{
    const fm_option *option = option_find(method, name);
    for (size_t i = 0; option != NULL && i < choice_count; i++)
        if (strcmp(choices[i].name, name) == 0)
            return choices[i].value;
    return option != NULL ? option->values[0] : NULL;
}

bool option_has_value(const fm_option *option, const char *value)
{
    for (size_t i = 0; i < FM_MAX_OPTION_VALUES && option->values[i] != NULL; i++)
        if (strcmp(option->values[i], value) == 0)
            return true;
    return false;
}

static bool condition_holds(const fm_resource *resource, const fm_method_desc *method,
                            const fm_choice *choices, size_t choice_count)
{
    const char *value = option_chosen(method, resource->when_option, choices, choice_count);
    return value != NULL && strcmp(value, resource->when_value) == 0;
}

static bool is_replaced(const fm_resource *resource, const fm_method_desc *method,
                        const fm_choice *choices, size_t choice_count)
{
    for (size_t i = 0; i < resource_count(method); i++) {
        const fm_resource *other = &method->resources[i];
        if (other->when_option != NULL && strcmp(other->name, resource->name) == 0 &&
            condition_holds(other, method, choices, choice_count))
            return true;
    }
    return false;
}

void method_choose(fm_method_desc *chosen, const fm_method_desc *method, const fm_choice *choices,
                   size_t choice_count)
{
    size_t count = 0;
    *chosen = *method;
    memset(chosen->resources, 0, sizeof chosen->resources);
    for (size_t i = 0; i < resource_count(method); i++) {
        const fm_resource *resource = &method->resources[i];
        const bool is_there = resource->when_option != NULL
                                  ? condition_holds(resource, method, choices, choice_count)
                                  : !is_replaced(resource, method, choices, choice_count);
        if (is_there)
            chosen->resources[count++] = *resource;
    }
}
