/* Colours of mesh vertices: shaded on the host, the same for every device. */
#ifndef FM_SHADE_H
#define FM_SHADE_H

#include <stdint.h>

#include "base/vec3.h"

/* 0xBBGGRR, before light and alpha. */
#define FM_STONE 0xBEE2FFu

/* RGBA8, premultiplied: base lit from both sides by one fixed light (Lambert; a quarter of full
 * brightness where it grazes, or with a normal of zero). The normal's length does not matter. */
uint32_t shade(vec3 normal, uint32_t base, double alpha);

#endif
