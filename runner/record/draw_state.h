/* OpenGL's state as a draw call of a frame.
 *
 * What the state does not tell is decided so. A texture is its name and a count of its uploads; its
 * opacity is the least alpha of its first level. Uniforms are all that the program has, or the
 * texture environment and fog of the fixed pipeline. A program discards, or computes depth, if its
 * fragment shader's text says so. Blending that is neither "over" nor additive counts as "over". */
#ifndef FM_RECORD_DRAW_STATE_H
#define FM_RECORD_DRAW_STATE_H

#include "gl_calls.h"
#include "polygons.h"

/* Names beyond share the last place, and so one version. */
enum { RECORD_TEXTURES = 16384, RECORD_PROGRAMS = 4096 };

typedef struct texture_note {
    uint32_t version;       /* uploads */
    uint32_t known_version; /* + 1, of which is known: */
    bool is_opaque;
} texture_note;

typedef struct program_note {
    bool is_known, discards, writes_depth;
} program_note;

/* Starts as {0} but for gl. */
typedef struct draw_state {
    gl_calls gl;
    texture_note textures[RECORD_TEXTURES];
    program_note programs[RECORD_PROGRAMS];
} draw_state;

/* The state of the current context. Alpha is finished when the corners' is known:
 * draw_state_alpha. */
fm_draw_call draw_state_read(draw_state *state, uint32_t vertices);
void draw_state_alpha(fm_draw_call *draw, draw_state *state, polygon_alpha corners);
polygon_view draw_state_view(draw_state *state, uint32_t height_px);

/* The texture bound to target has new contents. */
void draw_state_uploaded(draw_state *state, GLenum target);
/* Something was drawn into the framebuffer object that is bound. */
void draw_state_rendered(draw_state *state);

#endif
