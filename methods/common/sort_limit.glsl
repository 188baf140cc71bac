// The longest private array, in records of 8 bytes, that resolve sorts a pixel's N fragments in: on an H100
// 640 compile and take half the time of sorting in place; 2000 do not compile.
#define SORT_PRIVATE_MAX 640
#define SORTS_IN_PLACE (N > SORT_PRIVATE_MAX)
