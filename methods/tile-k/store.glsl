// The tile pass. Triangles come bucket by bucket, nearest first, so a fragment that lies in an earlier
// bucket than all triangles to come is final: it is composited at once and forgotten. Kept is only a
// window of the nearest fragments that are not final, so that k is but a count. What falls out of a full
// window is not lost: a further round over the block's triangles takes up behind the last one composited.
#define NO_KEY uvec2(0xFFFFFFFFu)
// Measured (README): where registers hold the window, places cost; elsewhere rounds do.
#if WINDOW != 0
#define ROOM WINDOW
#elif FM_HAS_SUBGROUP_BALLOT && FM_SUBGROUP_SIZE == 32
#define ROOM 32
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

// Measured (README): narrow subgroups run every branch, wide ones jump.
#if STRUCTURE == STRUCTURE_REGISTERS || (STRUCTURE == STRUCTURE_AUTO && LANES != 32)
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

void advance(uint bucket)
{
    now = bucket;
    FM_LOOP while (votes(emitted < uint(K) && is_final(window_first())) != 0u && may_go_on())
        if (emitted < uint(K) && is_final(window_first()))
            emit_first();
}

void take(uvec2 key)
{
    if (has_more && !comes_before(key, resumes) && comes_before(key, fallen)) {
        uvec2 out_of_room = window_insert(key);
        if (comes_before(out_of_room, fallen))
            fallen = out_of_room;
    }
}

void store(uint tile)
{
    own_pixel = uvec2(tile % TILES_X, tile / TILES_X) * 8u + pixel_in_tile(this_place());
    is_inside = own_pixel.x < uint(FM_WIDTH) && own_pixel.y < uint(FM_HEIGHT);
    emitted = 0u;
    resumes = uvec2(0u);
    if (is_inside)
        fm_emit_begin(own_pixel);
    uint bin = own_bin(tile), first = bins[bin * BIN_WORDS + BUCKETS];
    has_more = is_inside;
    FM_LOOP while (votes(has_more) != 0u && may_go_on()) {
        fallen = NO_KEY;
        window_clear();
        first = scan(bin, first, own_pixel);
        advance(BUCKETS); // all that is left is final
        has_more = has_more && emitted < uint(K) && fallen != NO_KEY;
    }
    if (is_inside && is_cut)
        fm_lost(own_pixel); // never silent
    if (is_inside)
        fm_emit_end(own_pixel);
}
