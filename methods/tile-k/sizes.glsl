// Sizes that the shaders and the descriptors (method.c here and of null-triangles) agree on. C includes
// this file too, so it holds preprocessor lines only.
#ifndef TILE_K_SIZES
#define TILE_K_SIZES

#define BUCKETS 32u                // of depth, in a block
#define BIN_WORDS (BUCKETS + 1u)   // of a block in bins[]: one a bucket, and where its pairs begin
#define TILE_BLOCKS_MAX 2u         // bins[] has room for so many, however many are used

// bins[] begins with a head, so that one command clears both: x y z of the large triangles' dispatch, then
#define HEAD_LARGE 3u // how many large triangles there are
#define HEAD_PAIRS 4u // how many pairs: the total that sizes pairs[]
#define HEAD_WORDS 5u

#define FILL_GROUPS_WORDS 3u  // x y z of the dispatch of `fill`
#define STORE_GROUPS_WORDS 4u // x y z of the dispatch of `store`, then
#define STORE_GROUPS_LISTED 3u // how many tiles are listed

#endif
