// The k nearest of an A-buffer's fragments in runs of a pass (FM_RESUMES), where they lie: in place of
// select.glsl. The method defines fragment_at() and put_fragment() as sort_in_place.glsl asks for them.
#define SORT_MOST K
#include "common/sort_in_place.glsl"

void emit_nearest(uvec2 pixel, uint count)
{
    emit_in_runs(pixel, count, min(count, uint(K)));
}
