#include <stdio.h>

#include "answer.h"
#include "protocol.h"
#include "technique_internal.h"

enum { NAME_BYTES = 96 }; /* of a metric */

energy_result technique_energy(const technique_run *run, const tbr_counters *counters,
                               double all_cycles, double spilled, const model_parameters *p)
{
    const energy_inputs inputs = {
        .counters = counters,
        .cycles = all_cycles,
        .spilled = spilled,
        .has_visibility = (run->parts & FM_PART_VISIBILITY) != 0,
        .has_signatures = (run->parts & FM_PART_SIGNATURES) != 0,
    };
    return energy_of(&inputs, p);
}

static void set_real(technique_run *run, const char *prefix, const char *name, const char *suffix,
                     double value)
{
    char metric[NAME_BYTES];
    snprintf(metric, sizeof metric, "%s%s%s", prefix, name, suffix);
    json_object_set_new(run->metrics, metric, json_real(value));
}

static double all_cycles(const technique_run *run)
{
    return run->cycle_sum.geometry[CYCLES_NOMINAL] + run->cycle_sum.raster[CYCLES_NOMINAL];
}

static void set_cycles(technique_run *run)
{
    const cycles_frame *sum = &run->cycle_sum;
    answer_set_number(run->metrics, FM_METRIC_CYCLES, all_cycles(run));
    set_real(run, "cycles.", "geometry", "", sum->geometry[CYCLES_NOMINAL]);
    set_real(run, "cycles.", "raster", "", sum->raster[CYCLES_NOMINAL]);
    set_real(run, "cycles.", "raster_b", "", sum->raster_b);
    set_real(run, "cycles.", "signature_stall", "", sum->signature_stall);
    for (size_t i = 0; i < sizeof sum->stages / sizeof sum->stages[0]; i++)
        set_real(run, "cycles.", cycles_stage_names[i], "", sum->stages[i]);
    for (size_t i = CYCLES_NOMINAL + 1; i < CYCLES_VARIANT_COUNT; i++)
        set_real(run, "cycles.", cycles_variants[i].name, "", sum->geometry[i] + sum->raster[i]);
}

static void set_energy(technique_run *run)
{
    char name[64];
    const double bytes = (double)(run->sum.attribute_bytes + run->sum.list_bytes);
    const double spilled = bytes > 0 ? run->spilled_sum / bytes : 0;
    const energy_result nominal =
        technique_energy(run, &run->sum, all_cycles(run), spilled, &run->table.nominal);
    answer_set_number(run->metrics, FM_METRIC_ENERGY_NJ, nominal.total);
    for (size_t i = 0; i < ENERGY_COMPONENT_COUNT; i++)
        set_real(run, "energy.", energy_names[i], "_nj", nominal.component[i]);
    for (unsigned i = 0; i < ENERGY_CORNERS; i++) {
        const model_parameters p = energy_corner(name, &run->table, i);
        set_real(run, "energy_corner.", name, "_nj",
                 technique_energy(run, &run->sum, all_cycles(run), spilled, &p).total);
    }
}

void technique_set_metrics(technique_run *run)
{
    for (size_t i = 0; i < TBR_COUNTER_COUNT; i++)
        json_object_set_new(run->metrics, tbr_counter_infos[i].name,
                            json_integer((json_int_t)counters_get(&run->sum, i)));
    answer_set_count(run->metrics, FM_METRIC_FRAGMENTS_GENERATED, run->sum.fragments_rasterised);
    set_cycles(run);
    set_energy(run);
    const double core_s = run->seconds * tbr_thread_count(run->gpu);
    answer_set_number(run->metrics, FM_METRIC_SIMULATED_RATE,
                      core_s > 0 ? (double)run->sum.fragments_rasterised / core_s : 0);
}

/* What of the simulator ran for this technique and sequence. */
void technique_set_modelled(json_t *answer, const technique_run *run)
{
    static const char *const names[] = { "visibility",   "signatures",  "taint",
                                         "exact ties",   "paper types", "owners",
                                         "prepass",      "final depth", "previous colour",
                                         "object order", "two buffers", "uploads" };
    _Static_assert(FM_PARTS_ALL == (1u << sizeof names / sizeof names[0]) - 1, "one a part");
    json_t *parts = json_array(), *scene = json_array();
    for (unsigned i = 0; i < sizeof names / sizeof names[0]; i++)
        if ((run->parts >> i & 1u) != 0)
            json_array_append_new(parts, json_string(names[i]));
    if (run->sum.layer_lookups > 0)
        json_array_append_new(scene, json_string("layers"));
    answer_set_modelled(answer, scene, parts, json_array());
}
