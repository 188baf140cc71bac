#include "cost.h"

/* Fragments of a scene before anything is drawn; a guess for meshes. */
static double guessed_fragments(const fm_settings *settings)
{
    const double pixels = (double)settings->width_px * settings->height_px;
    if (settings->generator != FM_GENERATOR_LAYERS)
        return pixels * 4.0 * settings->instances;
    return pixels * settings->pixel_density * settings->n * settings->fragment_probability;
}

/* Measured on two CPU cores with lavapipe: about 25 ns a fragment for a method's store, 7 ns for
 * the floor's, 200 ns to capture and check one; a GPU takes next to nothing. */
static double seconds_of(const fm_plan *plan, size_t index, uint32_t launches)
{
    const fm_settings *settings = &plan->cases[index].settings;
    if (plan->cases[index].skip != NULL)
        return 0.0;
    const double fragments = guessed_fragments(settings);
    const double frames = (double)settings->frames + settings->warmup;
    return launches * (1.0 + frames * fragments * 32e-9) + fragments * 200e-9;
}

double plan_case_seconds(const fm_plan *plan, size_t index)
{
    return seconds_of(plan, index, plan_case_launches(plan, index));
}

double plan_seconds(const fm_plan *plan)
{
    double seconds = 0.0;
    for (size_t i = 0; i < plan->count; i++)
        seconds += plan_case_seconds(plan, i);
    return seconds;
}

double plan_least_seconds(const fm_plan *plan)
{
    double seconds = 0.0;
    for (size_t i = 0; i < plan->count; i++)
        seconds += seconds_of(plan, i, plan_case_least_launches(plan, i));
    return seconds;
}
