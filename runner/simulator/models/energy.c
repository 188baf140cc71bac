#include "energy.h"

#include <stdio.h>

const char *const energy_names[ENERGY_COMPONENT_COUNT] = {
    [ENERGY_VERTEX] = "vertex",         [ENERGY_LISTS] = "lists",
    [ENERGY_LAYERS] = "layers",         [ENERGY_RASTERISER] = "rasteriser",
    [ENERGY_BUFFERS] = "buffers",       [ENERGY_SHADING] = "shading",
    [ENERGY_TEXTURE] = "texture",       [ENERGY_FLUSH] = "flush",
    [ENERGY_VISIBILITY] = "visibility", [ENERGY_SIGNATURES] = "signatures",
    [ENERGY_STATIC] = "static",
};

enum { QUADS_OF_TILE = 64, COMPUTE_LUTS = 8, ACCUMULATE_LUTS = 4 };

/* Bytes that are written through L2 and read back by the tile cache, and what of them spills. */
static double buffer_pj(double written, double read, double spilled, const model_parameters *p)
{
    return written / p->line_bytes * p->l2_write_line_pj +
           read / p->line_bytes * (p->l2_read_line_pj + p->tile_cache_line_pj) +
           spilled * (written + read) * p->dram_pj_per_byte;
}

static double lists_pj(const energy_inputs *in, const model_parameters *p)
{
    const tbr_counters *c = in->counters;
    const double layers = c->pairs > 0 ? (double)c->layer_bytes / (double)c->pairs : 0;
    const double read = (double)c->read_bytes - layers * (double)c->entries_read;
    return buffer_pj((double)(c->attribute_bytes + c->list_bytes), read, in->spilled, p);
}

static double layers_pj(const energy_inputs *in, const model_parameters *p)
{
    const tbr_counters *c = in->counters;
    const double layers = c->pairs > 0 ? (double)c->layer_bytes / (double)c->pairs : 0;
    return buffer_pj((double)c->layer_bytes, layers * (double)c->entries_read, in->spilled, p);
}

static double texture_pj(const tbr_counters *c, const model_parameters *p)
{
    const double bytes = (double)c->texture_bytes16 / 16 * p->texture_traffic;
    return (double)c->quads_shaded * p->texture_access_pj +
           bytes * (p->dram_pj_per_byte + p->l2_read_line_pj / p->line_bytes);
}

static double buffers_pj(const tbr_counters *c, const model_parameters *p)
{
    return (double)(c->depth_quad_reads + c->colour_quad_reads) * p->quad_read_pj +
           (double)(c->depth_quad_writes + c->colour_quad_writes) * p->quad_write_pj +
           (double)c->fragments_blended * p->blend_pj;
}

static double visibility_pj(const tbr_counters *c, const model_parameters *p)
{
    return (double)c->layer_lookups * (p->table_read_pj + p->table_write_pj) +
           (double)c->fvp_reads * (p->table_read_pj + p->compare_pj) +
           (double)c->fvp_writes * p->table_write_pj +
           (double)c->layer_quad_writes * p->quad_write_pj +
           (double)c->visibility_scans * 2 * QUADS_OF_TILE * p->quad_read_pj;
}

static double signatures_pj(const tbr_counters *c, const model_parameters *p)
{
    return (double)c->signed_bytes / p->compute_bytes_per_cycle * COMPUTE_LUTS * p->lut_read_pj +
           (double)c->signed_pairs *
               (p->signature_read_pj + p->signature_write_pj + ACCUMULATE_LUTS * p->lut_read_pj) +
           (double)c->signature_compares * (p->signature_read_pj + p->compare_pj);
}

energy_result energy_of(const energy_inputs *in, const model_parameters *p)
{
    const tbr_counters *c = in->counters;
    const double leaked_nj_per_mw = in->cycles / p->clock_mhz; /* mW x us */
    const double line_pj = p->vertex_line_pj + p->line_bytes * p->dram_pj_per_byte;
    const double powered_mw = p->logic_mw + p->dram_standby_mw + p->caches_mw + p->tile_buffers_mw;
    energy_result result = { .component = {
                                 [ENERGY_VERTEX] =
                                     (double)c->vertex_lines * line_pj +
                                     (double)c->vertex_instructions_run * p->vertex_instruction_pj,
                                 [ENERGY_LISTS] = lists_pj(in, p),
                                 [ENERGY_LAYERS] = layers_pj(in, p),
                                 [ENERGY_RASTERISER] = (double)c->scalar_quads * p->scalar_quad_pj,
                                 [ENERGY_BUFFERS] = buffers_pj(c, p),
                                 [ENERGY_SHADING] = (double)c->fragment_instructions_run *
                                                    p->fragment_instructions *
                                                    p->fragment_instruction_pj,
                                 [ENERGY_TEXTURE] = texture_pj(c, p),
                                 [ENERGY_FLUSH] = (double)c->flush_bytes *
                                                  (p->dram_pj_per_byte + p->quad_read_pj / 16),
                                 [ENERGY_VISIBILITY] = visibility_pj(c, p),
                                 [ENERGY_SIGNATURES] = signatures_pj(c, p),
                             } };
    for (int i = 0; i < ENERGY_COMPONENT_COUNT; i++)
        result.component[i] *= 1e-3;
    result.component[ENERGY_VISIBILITY] +=
        in->has_visibility ? p->visibility_mw * leaked_nj_per_mw : 0;
    result.component[ENERGY_SIGNATURES] +=
        in->has_signatures ? p->signature_mw * leaked_nj_per_mw : 0;
    result.component[ENERGY_STATIC] = powered_mw * leaked_nj_per_mw;
    for (int i = 0; i < ENERGY_COMPONENT_COUNT; i++)
        result.total += result.component[i];
    return result;
}

model_parameters energy_corner(char name[64], const model_table *table, unsigned corner)
{
    const model_parameters *levels[3] = { &table->nominal, &table->low, &table->high };
    const unsigned dram = corner % 3, alu = corner / 3 % 3, leak = corner / 9 % 3;
    const bool is_hp = corner / 27 % 2 != 0;
    model_parameters p = is_hp ? table->hp : table->nominal;
    p.dram_pj_per_byte = levels[dram]->dram_pj_per_byte;
    p.fragment_instruction_pj = levels[alu]->fragment_instruction_pj;
    p.logic_mw = levels[leak]->logic_mw;
    snprintf(name, 64, "%s.dram-%g.alu-%g.leak-%g", is_hp ? "hp" : "lop", p.dram_pj_per_byte,
             p.fragment_instruction_pj, p.logic_mw);
    return p;
}
