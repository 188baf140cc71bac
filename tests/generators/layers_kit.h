/* A layers scene for tests of the generator. */
#ifndef FM_LAYERS_KIT_H
#define FM_LAYERS_KIT_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "generators/generate.h"
#include "scene/layers.h"
#include "scene/scene.h"

static inline fm_settings layers_settings(uint32_t n)
{
    fm_settings s;
    settings_default(&s);
    s.generator = FM_GENERATOR_LAYERS;
    s.width_px = 854;
    s.height_px = 480;
    s.n = n;
    s.pixel_density = 0.25;
    s.fragment_probability = 1.0;
    s.tessellation = 4;
    s.order = FM_ORDER_RANDOM;
    s.depths = FM_DEPTHS_UNIFORM;
    s.colours = FM_COLOURS_HASH;
    s.alphas = FM_ALPHAS_CONSTANT;
    s.alpha = 0.5;
    s.seed = 7;
    return s;
}

static inline fm_scene *create(const fm_settings *settings)
{
    fm_scene *scene = NULL;
    fm_error err = { 0 };
    if (scene_create(&scene, settings, &err) != FM_OK)
        fail_msg("%s", err.message);
    return scene;
}

#endif
