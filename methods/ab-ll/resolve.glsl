#include "ab-ll/node.glsl"
#define SORT_CAPACITY N
#include "common/sort.glsl"

void resolve(uvec2 pixel)
{
    uint link = heads[fm_pixel_index(pixel)];
    uint count = 0u;
    FM_LOOP while (link != END_OF_LIST && count < N) {
        sorted[count++] = uvec2(nodes[link - 1u], nodes[link]);
        link = nodes[link + 1u];
    }
    sort_fragments(count);
    emit_sorted(pixel, count);
}
