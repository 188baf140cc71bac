// fm_emit of a pass that emits. The timed build composites front to back (colours are premultiplied):
//   C = C + c (1 - A),  A = A + a (1 - A),
// or, where FM_BACK_TO_FRONT is 1, each fragment over those before:
//   C = c + C (1 - a),  A as above.
// The checked build writes the fragments of the pixels of one band down instead.
#include "common/accumulate.glsl"

// The rank that the i-th turn of a loop hands over, of `count` ranks that the loop has all of.
#if FM_BACK_TO_FRONT
#define FM_RANK(i, count) ((count) - 1u - (i))
#else
#define FM_RANK(i, count) (i)
#endif

#ifdef FM_CAPTURE

void fm_emit(uvec2 pixel, int rank, float depth, uint colour)
{
    uint local = fm_pixel_index(pixel) - fm_band_first;
    if (local >= fm_band_pixels)
        return;
    uint slot = rank >= 0 ? uint(rank) : uint(FM_CAPTURE_SLOTS + rank);
    if (rank >= 0)
        fm_capture_counts[local].x = max(fm_capture_counts[local].x, uint(rank + 1));
    else
        fm_capture_counts[local].y = max(fm_capture_counts[local].y, uint(-rank));
    if (slot < uint(FM_CAPTURE_SLOTS))
        fm_capture[local * uint(FM_CAPTURE_SLOTS) + slot] = uvec2(floatBitsToUint(depth), colour);
}
void fm_blended(uvec2 pixel, vec4 colour)
{
}
void fm_emit_begin(uvec2 pixel)
{
}
void fm_emit_end(uvec2 pixel)
{
}

#else

// 1 - A is kept instead of A: near A = 1 a sum would stop short, and hundreds of layers would still show.
vec3 fm_front;
float fm_shows;
#ifdef FM_EMITS_BACK
vec4 fm_back;
#endif

// An approximation's one colour: it has no fragments, and the checked build finds none.
void fm_blended(uvec2 pixel, vec4 colour)
{
    vec4 c = fm_read_colour(colour);
#if FM_BACK_TO_FRONT
    FM_PRECISE vec3 front = c.rgb + fm_front * (1.0 - c.a);
#else
    FM_PRECISE vec3 front = fm_front + c.rgb * fm_shows;
#endif
    FM_PRECISE float shows = fm_shows * (1.0 - c.a);
    vec4 kept = fm_rounded(vec4(front, shows));
    fm_front = kept.rgb;
    fm_shows = kept.a;
}

void fm_emit(uvec2 pixel, int rank, float depth, uint colour)
{
    vec4 c = unpackUnorm4x8(colour);
#ifdef FM_EMITS_BACK
    if (rank < 0) { // each one lies before those already there
        c = fm_read_colour(c);
        FM_PRECISE vec4 back = c + fm_back * (1.0 - c.a);
        fm_back = fm_rounded(back);
        return;
    }
#endif
    fm_blended(pixel, c);
}

// Compositing outlives a pass: a looped method goes on where the last iteration ended. So fm_output keeps
// 1 - A, too; the host turns it into A when it reads the image.
void fm_emit_begin(uvec2 pixel)
{
    bool is_first = FM_EMIT_FIRST != 0 && fm_iteration == 0u && fm_run == 0u;
    vec4 before = is_first ? vec4(0.0, 0.0, 0.0, 1.0) : fm_output[fm_pixel_index(pixel)];
    fm_front = before.rgb;
    fm_shows = before.a;
#ifdef FM_EMITS_BACK
    fm_back = is_first ? vec4(0.0) : fm_output_back[fm_pixel_index(pixel)];
#endif
}
void fm_emit_end(uvec2 pixel)
{
    fm_output[fm_pixel_index(pixel)] = vec4(fm_front, fm_shows);
#ifdef FM_EMITS_BACK
    fm_output_back[fm_pixel_index(pixel)] = fm_back;
#endif
}

#endif
