#include "kb-mdt32/sink.glsl"
#include "kb-mdt32/put_colour.glsl"

void clear(uvec2 pixel)
{
    FM_LOOP for (uint i = 0u; i < K; ++i) {
        put_key(pixel, i, EMPTY);
#if !EQUAL_DEPTHS_MERGE
        put_colour(pixel, i, 0u); // of equal keys only the first slot gets one
#endif
    }
}
