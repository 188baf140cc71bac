#include "ab-ll/node.glsl"
#include "common/select.glsl"

void resolve(uvec2 pixel)
{
    uint link = heads[fm_pixel_index(pixel)];
    FM_LOOP for (uint count = 0u; link != END_OF_LIST && count < N; ++count) {
        select_nearest(uvec2(nodes[link - 1u], nodes[link]));
        link = nodes[link + 1u];
    }
    emit_selected(pixel);
}
