/* The closed form of a layers scene: which fragments each pixel has, without a device. What is here
 * reads the recipe that generators/layers.c made; methods/common/layers.glsl is its twin on
 * devices.
 *
 * Cells of a tessellation t go row by row: cell = cell_y * t + cell_x, which is also the row of
 * `order` that random-cell uses. */
#ifndef FM_LAYERS_H
#define FM_LAYERS_H

#include "scene.h"

/* A survival threshold at which all fragments live, and no hash is computed. */
#define LAYERS_ALL_LIVE 0xFFFFFFFFu

/* Whether the settings make layers whose depth is the same at every pixel, and none that a
 * rasteriser may flush to 0: then fragments are known exactly, and feeds replay them from the
 * recipe. False for all other generators. */
bool layers_are_flat(const fm_settings *settings);
/* Whether two fragments of a pixel may share a depth, or swap places by rounding: then more than
 * one order of them is right. True for all generators but layers, of which nothing is known
 * beforehand. */
bool layers_may_tie(const fm_settings *settings);

/* Where cell i of t begins, in px, and cell i - 1 ends; i = 0..t. begin, end: rect's x0, x1 or y0,
 * y1. Cells of less than a pixel may be empty. */
uint32_t layers_border(uint32_t begin, uint32_t end, uint32_t i, uint32_t t);
/* The hash that decides what is random of a fragment, bit for bit the same in GLSL:
 *
 *     uint32_t h = x + y * 0x9E3779B1u + layer * 0x85EBCA77u + seed32 * 0xC2B2AE3Du;
 *     h ^= h >> 16; h *= 0x7FEB352Du; h ^= h >> 15; h *= 0x846CA68Bu; h ^= h >> 16;
 *
 * x, y: pixel; layer: its rank in scene->layers; seed32 = (uint32_t)(seed ^ seed >> 32). */
uint32_t layers_hash(uint32_t x, uint32_t y, uint32_t layer, uint64_t seed);
/* Whether that fragment lives: its hash is below scene->survival_threshold. All fragments of other
 * generators do. */
bool layers_lives(const fm_scene *scene, uint32_t x, uint32_t y, uint32_t layer);

/* The fragments of one pixel in arrival order; room for scene->n. Returns how many. Flat layers are
 * exact, denormal ones before a rasteriser flushes them; the depth of sloped ones is evaluated in
 * double and rounded once, which a rasteriser's interpolation may miss by 2 steps of 2^-24 (more
 * ulp where depths are small). Depths are as methods see them (hand_on.h). */
uint32_t layers_fragments(fm_fragment *fragments, const fm_scene *scene, uint32_t x, uint32_t y);
/* The same fragments nearest first; only where layers do not tie. */
uint32_t layers_sorted(fm_fragment *fragments, const fm_scene *scene, uint32_t x, uint32_t y);

#endif
