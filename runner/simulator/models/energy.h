/* What a frame costs: events times picojoules, and power that is always drawn times the frame's
 * time. Cells, DRAM, arithmetic and leakage are uncertain by factors, so each is swept, all
 * combinations. */
#ifndef FM_TBR_ENERGY_H
#define FM_TBR_ENERGY_H

#include <stdbool.h>

#include "parameters.h"
#include "simulator/counters.h"

typedef enum energy_component {
    ENERGY_VERTEX, /* vertex cache, shader, memory */
    ENERGY_LISTS,  /* parameter buffer, without layers */
    ENERGY_LAYERS, /* layers in the parameter buffer */
    ENERGY_RASTERISER,
    ENERGY_BUFFERS, /* depth and colour on chip, blending */
    ENERGY_SHADING, /* fragment processors */
    ENERGY_TEXTURE,
    ENERGY_FLUSH,
    ENERGY_VISIBILITY, /* layer generator, layer buffer, FVP table: their accesses and leakage */
    ENERGY_SIGNATURES, /* signature buffer, CRC tables: the same */
    ENERGY_STATIC,     /* what every GPU leaks, DRAM's standby */
    ENERGY_COMPONENT_COUNT
} energy_component;
extern const char *const energy_names[ENERGY_COMPONENT_COUNT];

typedef struct energy_inputs {
    const tbr_counters *counters; /* of one frame or of many */
    double cycles;
    double spilled; /* part of the parameter buffer that goes to memory (cycles_spilled) */
    bool has_visibility, has_signatures; /* the hardware is there, used or not */
} energy_inputs;

/* Nanojoules. */
typedef struct energy_result {
    double component[ENERGY_COMPONENT_COUNT], total;
} energy_result;

energy_result energy_of(const energy_inputs *inputs, const model_parameters *p);

/* Corners of the sweep: cells {lop, hp} x DRAM, ALU, leakage {low, nominal, high}. */
enum { ENERGY_CORNERS = 2 * 3 * 3 * 3 };
/* The parameters of a corner, and its name, "hp.dram-160.alu-8.leak-60". */
model_parameters energy_corner(char name[64], const model_table *table, unsigned corner);

#endif
