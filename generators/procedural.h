/* Scenes of triangles that are made from a seed, and stand in for models that the papers used.
 *
 * All of them: coordinates come from integers, + - * / and square roots of doubles (turns.h where
 * an angle is needed), so that a scene is the same floats on every machine. Faces are flat, lit as
 * shade.h says. A stand-in has the properties that the papers print (scenes/README.md), which
 * tests/generators/generators_test.c asserts; its shape is our own. */
#ifndef FM_PROCEDURAL_H
#define FM_PROCEDURAL_H

#include "builder.h"
#include "scene/scene.h"

/* Fills what scene_place fills, the counts, and make_mesh, which makes the mesh itself. */
fm_status procedural_generate(fm_scene *scene, fm_error *err);
/* The mesh file settings.mesh inside a cube whose front covers settings.pixel_density of the
 * viewport; held, since a file is held. */
fm_status bunny_in_cube_generate(fm_scene *scene, fm_error *err);

/* The papers' synthetic scene: fills rect, layers, order and survival_threshold, which
 * scene/layers.h reads. FM_INVALID: more layers than their depths can tell apart; FM_NO_MEMORY. */
fm_status layers_generate(fm_scene *scene, fm_error *err);

/* What each makes stands in its file. */
void palace_build(fm_builder *b);
void hairball_build(fm_builder *b);
void engine_build(fm_builder *b);
void temple_build(fm_builder *b);
void hotel_build(fm_builder *b);
void ivy_build(fm_builder *b);

#endif
