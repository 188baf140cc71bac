// Every fragment decrements the stencil of all samples; it is written where the stencil was 2. So sample
// i takes arrival i. At 0 the stencil stays: no arrival arms a sample again.
void store(uvec2 pixel, float depth, uint colour)
{
    fm_target_routed = fm_pack(depth, colour);
}
