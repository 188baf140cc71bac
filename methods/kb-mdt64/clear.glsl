#include "kb-mdt64/sink.glsl"

void clear(uvec2 pixel)
{
    FM_LOOP for (uint i = 0u; i < K; ++i)
        put_key(pixel, i, EMPTY);
}
