// The triangles of a tile, bucket by bucket, against a block of pixels, one pixel a lane. Who includes
// this defines
//   bool is_full()               nothing more is wanted at this pixel
//   void advance(uint bucket)    every fragment to come lies in this bucket or behind it
//   void take(uvec2 key)         a fragment: (triangle, depth bits)
//   bool is_short()              a fragment found no room in this round
//   MAY_RESUME                   whether that can matter
// The scan ends early, or at the list's end, or gives up, which is_cut tells.
#include "common/rasterise.glsl"
#include "tile-k/layout.glsl"
#include "tile-k/lanes.glsl"

bool is_full();
void advance(uint bucket);
void take(uvec2 key);
bool is_short();

bool is_cut = false;
uint iterations = 0u; // of all loops of this subgroup

// Mesa's software ends all loops of an invocation together, without a word; a GPU should never hang.
#if FM_LOOP_LIMIT
const uint ITERATIONS_MAX = uint(FM_LOOP_LIMIT) - 64u;
#else
const uint ITERATIONS_MAX = 1u << 24;
#endif

// Once an iteration; false: too many.
bool may_go_on()
{
    is_cut = is_cut || ++iterations > ITERATIONS_MAX;
    return !is_cut;
}

// What a lane knows of its triangle, for the block.
struct lane_triangle {
    ivec3 a, b, edges; // at the block's corner
    vec2 xy;
    float z, dz_dx, dz_dy, z_least, z_most;
    uint number;
    bool is_there; // and may cover the block
};

lane_triangle set_up_lane(uint at, uint last, ivec2 block)
{
    lane_triangle l;
    fm_setup t;
    uint pair = at < last ? pairs[at] : pairs[last - 1u];
#if FM_CLIPS
    l.number = pair & TRIANGLE_MASK;
    fm_parts(l.number);
    fm_set_up(t, pair >> PART_SHIFT);
#else
    l.number = pair;
    fm_parts(l.number);
    fm_set_up(t, 0u);
#endif
    l.a = t.a;
    l.b = t.b;
    l.edges = fm_edges_at(t, block);
    l.xy = vec2(t.x[0], t.y[0]);
    l.z = t.z;
    l.dz_dx = t.dz_dx;
    l.dz_dy = t.dz_dy;
    l.z_least = t.z_least;
    l.z_most = t.z_most;
    l.is_there = at < last && fm_may_cover(t, l.edges, ivec2(BLOCK_W, BLOCK_H));
    return l;
}

// What lanes of a subgroup wrote is there for its others. Mesa's software runs a subgroup's lanes in
// lockstep and takes any barrier for the workgroup's, which not all subgroups reach as often.
void subgroup_fence()
{
#if LANES > 1 && FM_LOCK_BARRIERS
    subgroupMemoryBarrierShared();
    subgroupBarrier();
#endif
}

#if LANES == 32
#include "tile-k/chunk_wide.glsl"
#else
#include "tile-k/chunk_narrow.glsl"
#endif

// From the pair `from` on. Returns where a further round may start: the chunks before it hold nothing
// that lies behind what was final when the first fragment found no room (is_short()).
uint scan(uint tile, uint from, uvec2 pixel)
{
    read_range();
    uint ends = tile * TILE_WORDS, last = bins[ends + BUCKETS - 1u];
    ivec2 block = ivec2(pixel - pixel_in_tile(this_lane()));
    uint resume = from, chunk = from, bucket = 0u;
    uint reach_before = 0u, reach = 0u; // farthest buckets of this lane's triangles: but the last; the last
    FM_LOOP while (chunk < last) {
        FM_LOOP while (bins[ends + bucket] <= chunk)
            ++bucket;
        advance(bucket);
        iterations += 2u;
        if (!may_go_on() || votes(!is_full()) == 0u)
            break;
        if (MAY_RESUME && votes(reach_before >= bucket || is_short()) == 0u && chunk > from)
            resume = chunk - uint(LANES);
        uint end = bins[ends + bucket];
        FM_LOOP do { // chunks that begin in this bucket
            lane_triangle mine = set_up_lane(chunk + this_lane(), last, block);
            reach_before = max(reach_before, reach);
            reach = mine.is_there ? bucket_of(mine.z_most) : 0u;
            scan_chunk(mine, pixel, block);
            chunk += uint(LANES);
        } while (chunk < end && may_go_on());
    }
    return resume;
}
