#include "technique.h"

#include <string.h>

#include "plan_case.h"

static const char *chosen_value(const fm_method_desc *method, const char *name,
                                const fm_choice *choices, size_t count)
{
    for (size_t i = 0; i < count; i++)
        if (strcmp(choices[i].name, name) == 0)
            return choices[i].value;
    return option_find(method, name)->values[0];
}

uint32_t technique_parts(const fm_method_desc *method, const fm_choice *choices, size_t count)
{
    const fm_technique *technique = method->technique;
    uint32_t parts = technique->parts;
    for (size_t i = 0; i < FM_MAX_PART_CHOICES; i++) {
        const fm_part_choice *choice = &technique->choices[i];
        if (choice->option != NULL &&
            strcmp(chosen_value(method, choice->option, choices, count), choice->value) == 0)
            parts |= choice->parts;
    }
    return parts;
}
