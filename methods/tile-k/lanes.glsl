// The invocations that work together: a subgroup of 8 to 32 where the device has ballots, else each
// alone. LANES of them hold LANES pixels side by side and set up LANES triangles at a time.
#ifndef LANES // once
#ifndef CHUNK // is an option of the method
#define CHUNK 0
#define CHUNK_AUTO 0
#define CHUNK_WIDE 1
#define CHUNK_ALONE 3
#endif
#if CHUNK != CHUNK_ALONE && FM_HAS_SUBGROUP_BALLOT && FM_SUBGROUP_SIZE >= 8 && FM_SUBGROUP_SIZE <= 32
#define LANES FM_SUBGROUP_SIZE
#define this_lane() gl_SubgroupInvocationID
#define this_place() (gl_SubgroupID * uint(LANES) + gl_SubgroupInvocationID)
#define votes(condition) subgroupBallot(condition).x
#else
#define LANES 1
#define this_lane() 0u
#define this_place() fm_lane
#define votes(condition) ((condition) ? 1u : 0u)
#endif
const uint LANES_W = LANES >= 32 ? 8u : LANES >= 8 ? 4u : 1u;
const uint LANES_H = LANES >= 16 ? 4u : LANES >= 8 ? 2u : 1u;
#define IS_WIDE (CHUNK == CHUNK_WIDE || (CHUNK == CHUNK_AUTO && LANES == 32))
#endif
