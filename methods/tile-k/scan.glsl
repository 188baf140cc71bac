// The triangles of a block, bucket by bucket, against pixels of it, one a lane. Who includes
// this defines
//   bool is_full()               nothing more is wanted at this pixel
//   void advance(uint bucket)    every fragment to come lies in this bucket or behind it
//   void take(uvec2 key)         a fragment: (triangle, depth bits)
//   bool is_short()              a fragment found no room in this round
//   MAY_RESUME                   whether that can matter
// The scan ends early, or at the list's end, or gives up, which is_cut tells.
#include "tile-k/lanes.glsl"
#define FM_NEAR_WAYS IS_WIDE
#include "common/rasterise.glsl"
#include "tile-k/layout.glsl"

bool is_full();
void advance(uint bucket);
void take(uvec2 key);
bool is_short();

bool is_cut = false;
uint iterations = 0u; // of all loops of this subgroup

// Mesa's software ends all loops of an invocation together, without a word. Elsewhere they run as long as they have
// to: each turn goes on in the list of pairs, or emits.
const uint ITERATIONS_MAX = uint(FM_LOOP_LIMIT) / 8u * 7u; // some loops are not counted

#if LANES == 1 && FM_LOOP_LIMIT
// Invocations that work alone share a vector with seven others there, and their loops add up: each goes on
// from the count of the one that has the most.
shared uint iterations_of[FM_GROUP_LANES / 8];

void begin_counting()
{
    iterations_of[fm_lane / 8u] = 0u;
}

void count_together()
{
    uint most = atomicMax(iterations_of[fm_lane / 8u], iterations); // a maximum: in any order
    iterations = max(iterations, most);
}
#else
void begin_counting()
{
}

void count_together()
{
}
#endif

// Once an iteration; false: too many.
bool may_go_on()
{
    is_cut = FM_LOOP_LIMIT != 0 && (is_cut || ++iterations > ITERATIONS_MAX);
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

// The pixels of a subgroup, one bit each and not none: least x y and size of what holds them.
ivec4 rect_of(uint bits)
{
    uint columns = (bits | bits >> 2) & 0x33333333u, rows = (bits | bits >> 1) & 0x55555555u;
    columns = (columns | columns >> 8) & 0x00330033u; // y left out of the Morton order
    rows = (rows | rows >> 4) & 0x0F0F0F0Fu; // x left out
    rows = (rows | rows >> 16) & 0x00000F0Fu;
    ivec2 least = ivec2(pixel_in_tile(uint(findLSB(columns))).x, pixel_in_tile(uint(findLSB(rows))).y);
    ivec2 most = ivec2(pixel_in_tile(uint(findMSB(columns))).x, pixel_in_tile(uint(findMSB(rows))).y);
    return ivec4(least, most - least + 1);
}

// The triangle that this lane looks at, its corners snapped.
fm_setup snapped;
vec3 snapped_z;
uint snapped_number;

// Snaps a pair after fm_parts(number_of(pair)). Whether its box touches pixels that want more, which `open`
// holds: from the subgroup's corner on.
bool snap_lane(uint pair, ivec2 corner, ivec4 open)
{
    ivec2 least = corner + open.xy;
    snapped_number = number_of(pair);
    bool has_pixels = fm_snap_part(snapped, snapped_z, part_of(pair));
    return has_pixels && all(lessThan(snapped.box.xy, least + open.zw))
        && all(greaterThanEqual(snapped.box.zw, least));
}

lane_triangle set_up_lane(bool touches, ivec2 corner, ivec4 open) // after snap_lane()
{
    lane_triangle l;
    fm_setup t = snapped;
    fm_set_up_snapped(t, snapped_z);
    l.number = snapped_number;
    l.a = t.a;
    l.b = t.b;
    l.edges = fm_edges_at(t, corner);
    l.xy = vec2(t.x[0], t.y[0]);
    l.z = t.z;
    l.dz_dx = t.dz_dx;
    l.dz_dy = t.dz_dy;
    l.z_least = t.z_least;
    l.z_most = t.z_most;
    l.is_there = touches && fm_may_cover(t, l.edges + t.a * open.x + t.b * open.y, open.zw);
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

// The tile of an invocation of `store`; false: none.
bool tile_of(uint i, out uint tile)
{
    uint group = i / uint(FM_GROUP_LANES);
    bool is_there = group < (LISTS_TILES ? store_groups[STORE_GROUPS_LISTED] : TILES);
    tile = !is_there ? 0u : LISTS_TILES ? listed_tile_at(group) : group; // the dispatch may be larger
    return is_there;
}

// The bin of this lane's pixel.
uint own_bin(uint tile)
{
    return tile * TILE_BLOCKS + this_place() / (uint(FM_GROUP_LANES) / TILE_BLOCKS);
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

// Snaps this lane's triangle of a chunk; whether its box touches the pixels that `open` holds. Goes on to
// the next chunk: of that `pair` is this lane's, and of the one behind it `next`.
bool look_at(inout uint chunk, inout uint pair, inout uint next, uint last, ivec2 corner, ivec4 open)
{
    if (!FETCHES_AHEAD) {
        pair = pair_at(chunk, last);
        fm_parts(number_of(pair));
    }
    bool touches = snap_lane(pair, corner, open) && chunk + this_lane() < last;
    chunk += uint(LANES);
    if (FETCHES_AHEAD) {
        pair = next;
        fm_parts(number_of(pair));
        next = pair_at(chunk + uint(LANES), last);
    }
    return touches;
}

// From the pair `from` of a bin on. Returns where a further round may start: the chunks before it hold
// nothing that lies behind what was final when the first fragment found no room (is_short()).
uint scan(uint bin, uint from, uvec2 pixel)
{
    uint ends = words_of(bin), last = min(bins[ends + BUCKETS - 1u], fm_length_pairs);
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
        count_together();
        advance(bucket);
        count_together();
        iterations += 2u;
        uint wanting = votes(!is_full());
        if (!may_go_on() || wanting == 0u)
            break;
        ivec4 open = rect_of(wanting);
        if (MAY_RESUME && votes(reach_before >= bucket || is_short()) == 0u && chunk > from)
            resume = chunk - uint(LANES);
        uint end = min(bins[ends + bucket], last);
        FM_LOOP do { // chunks that begin in this bucket
            reach_before = max(reach_before, reach);
#if LANES > 1
            bool touches;
            FM_LOOP do // past those that no open pixel has part in
                touches = look_at(chunk, pair, next, last, corner, open);
            while (votes(touches) == 0u && chunk < end && may_go_on());
#else // alone, but in one vector with others, whose loops would add up
            bool touches = look_at(chunk, pair, next, last, corner, open);
#endif
            lane_triangle mine = set_up_lane(touches, corner, open);
            reach = mine.is_there ? bucket_of(fm_farthest(mine.z_least, mine.z_most)) : 0u;
            scan_chunk(mine, pixel, corner);
        } while (chunk < end && may_go_on());
    }
    return resume;
}
