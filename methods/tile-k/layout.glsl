// Bins: a tile of 8 x 8 pixels has TILE_BLOCKS blocks, each with 32 buckets of depth by a triangle's
// nearest corner. bins[] holds 33 words a block, from words_of(bin) on: while counting, each bucket's pairs; then where each
// bucket's next pair goes, and at the end where it ends; the last word is where the block's pairs begin.
#include "tile-k/lanes.glsl"
#include "tile-k/sizes.glsl"

const uint TILES_X = (uint(FM_WIDTH) + 7u) / 8u;
const uint TILES = TILES_X * ((uint(FM_HEIGHT) + 7u) / 8u);

// A wide subgroup covers 8 x 4 pixels: small triangles, as they are where there are many more of them than pixels, lie
// in one half of a tile, and the other half need not look at them. Elsewhere more pairs cost more than they save (4:
// measured, README).
#ifndef BLOCKS // is an option of the method
#define BLOCKS 0
#endif
#if BLOCKS == 2 || (BLOCKS == 0 && LANES == 32 && FM_TRIANGLES > 4 * FM_WIDTH * FM_HEIGHT)
const uint TILE_BLOCKS = 2u;
const ivec2 BLOCK_SHIFT = ivec2(3, 2);
#else
const uint TILE_BLOCKS = 1u;
const ivec2 BLOCK_SHIFT = ivec2(3, 3);
#endif
const ivec2 BLOCK_PX = ivec2(1) << BLOCK_SHIFT;

// The bin of the block at `block`, in blocks.
uint bin_of(ivec2 block)
{
    uint row = uint(block.y);
    return (row / TILE_BLOCKS * TILES_X + uint(block.x)) * TILE_BLOCKS + row % TILE_BLOCKS;
}

// Where setting a triangle up costs more than remembering it, `count` leaves `fill` a note of each triangle.
#ifndef NOTES // is an option of the method
#define NOTES 0
#define NOTES_AUTO 0
#define NOTES_ALWAYS 1
#endif
#if (NOTES == NOTES_ALWAYS || (NOTES == NOTES_AUTO && LANES == 32)) && !FM_CLIPS && FM_WIDTH <= 8192 \
    && FM_HEIGHT <= 8192
#define TAKES_NOTES 1
#else
#define TAKES_NOTES 0
#endif

// triangle_words[] has a word for each triangle, tile_words[] one for each tile. Only these names know what
// they hold:
//                 triangle_words[]              tile_words[]
//   TAKES_NOTES   the note of each triangle     the list of large triangles
//   else          the list of large triangles   the list of tiles that have pairs (LISTS_TILES)
// As macros: not every pass has both buffers.
#if TAKES_NOTES
#define note_at(triangle) triangle_words[triangle]
#define large_at(i) tile_words[i]
#else
#define large_at(i) triangle_words[i]
#endif
#define listed_tile_at(i) tile_words[i]

uint words_of(uint bin)
{
    return HEAD_WORDS + bin * BIN_WORDS;
}

// Whether `store` runs for listed tiles instead of all. Narrow subgroups are in practice those of software,
// which runs all of a shader for a tile that has nothing: there the tiles that have pairs are listed, unless
// notes need the room.
const bool LISTS_TILES = FM_NARROW != 0 && TAKES_NOTES == 0;
const uint GROUPS_X = 32768u; // of a dispatch, then y

// Groups that take the small triangles in `fill`; large ones have groups behind them.
const uint SMALL_GROUPS = (uint(FM_TRIANGLES) + uint(FM_GROUP_LANES) - 1u) / uint(FM_GROUP_LANES);

// A pair is the triangle's number and, above 29 bits, which part of a clipped one.
const uint PART_SHIFT = 29u;
const uint TRIANGLE_MASK = (1u << PART_SHIFT) - 1u;

// Triangles whose box has more blocks, or whose width and height reach farther, go to a list: a workgroup for
// each, an invocation for a stretch.
const int REACH_PX = 64; // so far fm_edges_at() can be stepped (common/rasterise.glsl)
const int SMALL_BLOCKS = 16 * int(TILE_BLOCKS);
const ivec2 LARGE_STRETCH = ivec2(4);

// How many the list may have. A large triangle that finds no room is not listed, which is right and slower.
#if TAKES_NOTES
const uint LARGE_MAX = TILES;
#else
const uint LARGE_MAX = uint(FM_TRIANGLES);
#endif
// A note: the blocks of a box of up to 2 x 2 that are covered, a bit each, the bucket, and the first block.
const uint NOTE_AGAIN = 1u << 31; // set it up again (so blocks have 22 bits)
const uint NOTE_BUCKET = 4u, NOTE_BLOCK = 9u; // shifts

// Which bucket a depth falls into: never falls as z rises, which is all that exactness needs. So the scene's
// range of depths may be any that pays; `precise`, as passes must agree.
uint bucket_of(float z)
{
    precise float width = max(FM_FARTHEST - FM_NEAREST, 1e-30);
    precise float scale = float(USED_BUCKETS) * fm_reciprocal(width);
    precise float at = (z - FM_NEAREST) * scale;
    return uint(clamp(at, 0.0, float(USED_BUCKETS) - 1.0));
}

// The i-th pixel of a tile in Morton order: 8 make 4 x 2, 32 make 8 x 4.
uvec2 pixel_in_tile(uint i)
{
    return uvec2((i & 1u) | (i >> 1u & 2u) | (i >> 2u & 4u), (i >> 1u & 1u) | (i >> 2u & 2u) | (i >> 3u & 4u));
}
