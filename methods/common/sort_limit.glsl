// The longest private array, in records of 8 bytes, that resolve sorts a pixel's N fragments in.
#ifndef SORT_PRIVATE_MAX
#define SORT_PRIVATE_MAX 256
#endif
#define SORTS_IN_PLACE (N > SORT_PRIVATE_MAX)
