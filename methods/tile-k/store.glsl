// The tile pass. Triangles come bucket by bucket, nearest first, so a fragment that lies in an earlier
// bucket than all triangles to come is final: it is composited at once and forgotten. Kept is only a
// window of the nearest fragments that are not final, so that k is but a count. What falls out of a full
// window is not lost: a further round over the block's triangles takes up behind the last one composited.
#define NO_KEY uvec2(0xFFFFFFFFu)
#include "tile-k/lanes.glsl"
// Measured (README): where registers hold the window, places cost; elsewhere rounds do.
#if STRUCTURE == STRUCTURE_SHARED_ARRAY && (WINDOW == 0 || WINDOW > 32) // what shared memory has room for
#define ROOM 32
#elif STRUCTURE == STRUCTURE_MERGE && WINDOW > 64 // what registers have room for
#define ROOM 64
#elif WINDOW != 0
#define ROOM WINDOW
#elif K > 256 && (STRUCTURE == STRUCTURE_AUTO || STRUCTURE == STRUCTURE_SORTED_ARRAY) // a bucket may have many
#define ROOM 64
#elif LANES == 32
#define ROOM 32
#elif LANES == 1
#define ROOM 16
#else
#define ROOM 8
#endif
#if K < ROOM
#define CAPACITY K
#else
#define CAPACITY ROOM
#endif
#define MAY_RESUME (K > CAPACITY)

bool comes_before(uvec2 a, uvec2 b) // by depth, then drawing order
{
    return a.y < b.y || (a.y == b.y && a.x < b.x);
}

#include "tile-k/scan.glsl"

// Measured (README): narrow subgroups run every branch; wide ones jump, which pays sooner.
#if STRUCTURE == STRUCTURE_MERGE
#include "tile-k/window_merge.glsl"
#elif STRUCTURE == STRUCTURE_REGISTERS \
    || (STRUCTURE == STRUCTURE_AUTO && (CAPACITY <= 8 || (LANES != 32 && CAPACITY <= 16)))
#include "tile-k/window_registers.glsl"
#else
#include "tile-k/window_sorted_array.glsl"
#endif

uvec2 own_pixel;
bool is_inside; // the viewport
bool has_more;  // is not done since the last round
uint emitted;
uvec2 resumes; // keys before it were composited in an earlier round
uvec2 fallen;  // the nearest that found no room in this round
uint now;      // every fragment to come lies in this bucket or behind it

bool is_final(uvec2 key)
{
    return key.y != NO_KEY.y && bucket_of(uintBitsToFloat(key.y)) < now;
}

// Nothing more can enter the window: all fragments to come lie behind one that fell out.
bool is_full()
{
    return !has_more || emitted == uint(K) || is_final(fallen);
}

bool is_short()
{
    return fallen != NO_KEY;
}

void emit_first()
{
    uvec2 key = window_first();
    fm_emit(own_pixel, int(emitted), uintBitsToFloat(key.y), fm_triangle_colour(key.x));
    ++emitted;
    resumes = uvec2(key.x + 1u, key.y);
    window_remove_first();
}

bool first_is_final()
{
    return emitted < uint(K) && is_final(window_first());
}

void let_fall(uvec2 key)
{
    if (comes_before(key, fallen))
        fallen = key;
}

void advance(uint bucket)
{
    now = bucket;
    let_fall(window_settle());
#if LANES == 32 // each for itself, then together: a vote in each turn took a sixth of the pass
    FM_LOOP while (first_is_final())
        emit_first();
#else
    FM_LOOP do // the test is last: see bin.glsl
        if (first_is_final())
            emit_first();
    while (votes(first_is_final()) != 0u && may_go_on());
#endif
}

void take(uvec2 key)
{
    if (has_more && (!MAY_RESUME || !comes_before(key, resumes)) && comes_before(key, fallen))
        let_fall(window_insert(key));
}

void store(uint i)
{
    uint tile;
    begin_counting();
    bool is_there = tile_of(i, tile);
    own_pixel = uvec2(tile % TILES_X, tile / TILES_X) * 8u + pixel_in_tile(this_place());
    is_inside = is_there && own_pixel.x < uint(FM_WIDTH) && own_pixel.y < uint(FM_HEIGHT);
    emitted = 0u;
    resumes = uvec2(0u);
    if (is_inside)
        fm_emit_begin(own_pixel);
    uint bin = own_bin(tile), first = bins[words_of(bin) + BUCKETS];
    has_more = is_inside;
    FM_LOOP while (votes(has_more) != 0u && may_go_on()) {
        fallen = NO_KEY;
        window_clear();
        first = scan(bin, first, own_pixel);
        advance(BUCKETS); // all that is left is final
        has_more = has_more && emitted < uint(K) && fallen != NO_KEY;
    }
#if FM_LOOP_LIMIT // whatever used the iterations up, counted or not: then no loop goes on
    uint turns = 0u;
    FM_LOOP while (turns < 8u + min(fm_length_pairs, 2u)) // as often as no compiler knows
        ++turns;
    is_cut = is_cut || turns < 8u;
#endif
    if (is_inside && is_cut)
        fm_cut(); // never silent
    if (is_inside)
        fm_emit_end(own_pixel);
}
