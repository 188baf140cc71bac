/* What a case asks for: how many fragments of a pixel, and how they are composited. */
#include "measure_internal.h"

uint32_t measure_wanted(const fm_method_desc *method, uint32_t k)
{
    switch (method->keeps) {
    case FM_KEEPS_K_NEAREST:
        return k;
    case FM_KEEPS_NEAREST:
        return 1;
    case FM_KEEPS_ALL:
    case FM_KEEPS_ALL_IN_K:
    case FM_KEEPS_COUNT:
        break;
    }
    return UINT32_MAX;
}

uint32_t measure_places(const fm_method_desc *method, uint32_t k)
{
    const uint32_t wanted = method->keeps == FM_KEEPS_ALL_IN_K ? k : measure_wanted(method, k);
    return wanted == UINT32_MAX ? 0 : wanted;
}

uint32_t measure_k(const fm_measurement *measurement, const fm_measure_desc *desc)
{
    return measurement->k_chosen > 0
               ? measurement->k_chosen
               : measure_wanted(desc->method->method, desc->method->settings->k);
}

fm_rounding measure_rounding(const fm_measure_desc *desc)
{
    const fm_settings *settings = desc->method->settings;
    return (fm_rounding){ settings->accumulate, settings->composite };
}
