// The triangles of a block, bucket by bucket, against pixels of it, one a lane. Who includes
// this defines
//   bool is_full()               nothing more is wanted at this pixel
//   void advance(uint bucket)    every fragment to come lies in this bucket or behind it
//   void take(uvec2 key)         a fragment: (triangle, depth bits)
//   bool is_short()              a fragment found no room in this round
//   MAY_RESUME                   whether that can matter
// The scan ends early, or at the list's end, or gives up, which is_cut tells.
#include "common/rasterise.glsl"
#include "tile-k/layout.glsl"

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

// What a lane knows of its triangle, for the lanes' pixels.
struct lane_triangle {
    ivec3 a, b, edges; // at the first lane's pixel
    vec2 xy;
    float z, dz_dx, dz_dy, z_least, z_most;
    uint number;
    bool is_there; // and may cover one of them
};

// The pair of this lane in the chunk at `at`; behind the end, the last one.
uint pair_at(uint at, uint last)
{
    return pairs[min(at + this_lane(), last - 1u)];
}

#if FM_CLIPS
#define number_of(pair) ((pair) & TRIANGLE_MASK)
#define part_of(pair) ((pair) >> PART_SHIFT)
#else
#define number_of(pair) (pair)
#define part_of(pair) 0u
#endif

// After fm_parts(number_of(pair)).
lane_triangle set_up_lane(uint pair, bool is_in, ivec2 corner)
{
    lane_triangle l;
    fm_setup t;
    l.number = number_of(pair);
    fm_set_up(t, part_of(pair));
    l.a = t.a;
    l.b = t.b;
    l.edges = fm_edges_at(t, corner);
    l.xy = vec2(t.x[0], t.y[0]);
    l.z = t.z;
    l.dz_dx = t.dz_dx;
    l.dz_dy = t.dz_dy;
    l.z_least = t.z_least;
    l.z_most = t.z_most;
    l.is_there = is_in && fm_may_cover(t, l.edges, ivec2(LANES_W, LANES_H));
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

#if IS_WIDE
#include "tile-k/chunk_wide.glsl"
#else
#include "tile-k/chunk_narrow.glsl"
#endif

// The bin of this lane's pixel.
uint own_bin(uint tile)
{
    return tile * BLOCKS + this_place() / (uint(FM_GROUP_LANES) / BLOCKS);
}

// The first bucket that ends behind the pair `at`, which is not before the bucket `from`.
uint bucket_behind(uint at, uint own_end, uint ends, uint from)
{
#if LANES == 32
    return uint(bitCount(votes(own_end <= at))); // lane i: where bucket i ends
#else
    FM_LOOP while (bins[ends + from] <= at)
        ++from;
    return from;
#endif
}

// Where lanes wait for memory, what the next chunk needs is asked for before this one is scanned.
const bool FETCHES_AHEAD = LANES == 32;

// From the pair `from` of a bin on. Returns where a further round may start: the chunks before it hold
// nothing that lies behind what was final when the first fragment found no room (is_short()).
uint scan(uint bin, uint from, uvec2 pixel)
{
    read_range();
    uint ends = bin * BIN_WORDS, last = bins[ends + BUCKETS - 1u];
    uint own_end = bins[ends + this_lane()];
    ivec2 corner = ivec2(pixel - pixel_in_tile(this_lane()));
    uint resume = from, chunk = from, bucket = 0u;
    uint reach_before = 0u, reach = 0u; // farthest buckets of this lane's triangles: but the last; the last
    uint pair = 0u, next = 0u; // this chunk's and the next one's
    if (FETCHES_AHEAD && chunk < last) {
        pair = pair_at(chunk, last);
        next = pair_at(chunk + uint(LANES), last);
        fm_parts(number_of(pair));
    }
    FM_LOOP while (chunk < last) {
        bucket = bucket_behind(chunk, own_end, ends, bucket);
        advance(bucket);
        iterations += 2u;
        if (!may_go_on() || votes(!is_full()) == 0u)
            break;
        if (MAY_RESUME && votes(reach_before >= bucket || is_short()) == 0u && chunk > from)
            resume = chunk - uint(LANES);
        uint end = bins[ends + bucket];
        FM_LOOP do { // chunks that begin in this bucket
            if (!FETCHES_AHEAD) {
                pair = pair_at(chunk, last);
                fm_parts(number_of(pair));
            }
            lane_triangle mine = set_up_lane(pair, chunk + this_lane() < last, corner);
            chunk += uint(LANES);
            if (FETCHES_AHEAD) {
                pair = next;
                fm_parts(number_of(pair));
                next = pair_at(chunk + uint(LANES), last);
            }
            reach_before = max(reach_before, reach);
            reach = mine.is_there ? bucket_of(mine.z_most) : 0u;
            scan_chunk(mine, pixel, corner);
        } while (chunk < end && may_go_on());
    }
    return resume;
}
