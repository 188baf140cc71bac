#include "ab-ll/nodes.glsl"
#if FM_RESUMES // all of the list sorted, in runs; then its first k
#define LIST_MOST K
#include "ab-ll/sort_links_in_runs.glsl"

void resolve(uvec2 pixel)
{
    resolve_list(pixel, fm_pixel_index(pixel), 0u);
}
#else
#include "common/select.glsl"

void resolve(uvec2 pixel)
{
    uint link = heads[fm_pixel_index(pixel)];
    select_none();
    FM_LOOP for (uint count = 0u; link != END_OF_LIST && count < N; ++count) {
        uvec3 node = node_at(link);
        link = node.z;
        select_nearest(node.xy);
    }
    emit_selected(pixel);
}
#endif
