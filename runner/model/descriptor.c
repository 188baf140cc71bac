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
