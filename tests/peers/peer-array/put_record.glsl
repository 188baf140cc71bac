#include "peer-array/record.glsl"

void put_record(uvec2 pixel, uint i, uvec2 record)
{
#if K > 1
    fm_store_fragments(pixel, i, uvec4(record, 0u, 0u));
#else
    fm_store_fragments(pixel, uvec4(record, 0u, 0u));
#endif
}
