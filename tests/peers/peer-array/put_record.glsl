#include "peer-array/record.glsl"

void put_record(uvec2 pixel, uint i, uvec2 record)
{
    fm_store_fragments(pixel, i, uvec4(record, 0u, 0u));
}
