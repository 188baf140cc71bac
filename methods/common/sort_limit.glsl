// How resolve sorts a pixel's N fragments: the method's option sort decides, if it has one.
//   shell      as published, in a private array
//   registers  the same, but up to 32 in registers
//   blocks     in blocks of 32 in registers, which are merged: no private array
// SORT_PRIVATE_MAX is the longest private array, in records of 8 bytes: on an H100 640 compile and take half the time of
// sorting in place; 2000 do not compile. Blocks have heads in registers, 32 at most. Beyond, sorting is in place.
#define SORT_PRIVATE_MAX 640
#define SORT_BLOCKS_MAX  1024
#if defined(SORT_BLOCKS) && SORT == SORT_BLOCKS && N <= SORT_BLOCKS_MAX && !FM_RESUMES
#define SORTS_BY_NETWORK 1
#define SORTS_IN_PLACE   0
#include "common/sort_blocks.glsl"
#elif defined(SORT_REGISTERS) && SORT == SORT_REGISTERS && N <= SORT_PRIVATE_MAX
#define SORTS_BY_NETWORK 1
#define SORTS_IN_PLACE   0
#include "common/sort_registers.glsl"
#else
#define SORTS_BY_NETWORK 0
#define SORTS_IN_PLACE   (N > SORT_PRIVATE_MAX)
#endif
