#include "technique.h"

#include <string.h>

uint32_t technique_parts(const fm_method_desc *method, const fm_choice *choices, size_t count)
{
    const fm_technique *technique = method->technique;
    uint32_t parts = technique->parts;
    for (size_t i = 0; i < FM_MAX_PART_CHOICES; i++) {
        const fm_part_choice *choice = &technique->choices[i];
        if (choice->option != NULL &&
            strcmp(option_chosen(method, choice->option, choices, count), choice->value) == 0)
            parts |= choice->parts;
    }
    return parts;
}
