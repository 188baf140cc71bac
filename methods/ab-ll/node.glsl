// A node is a fragment (depth bits, colour) and a link to the next one; 0 ends a list. By the method's option node
//   split   three words of a pool of words; a link holds the first one's number plus one
//   whole   16 bytes of a pool of such, written and read at once; a link holds the node's number plus one
// A method without the option has split ones. nodes.glsl reads and writes them.
#if defined(NODE_WHOLE) && NODE == NODE_WHOLE
#define NODES_WHOLE 1
const uint NODE_STEP = 1u; // elements of the pool
#else
#define NODES_WHOLE 0
const uint NODE_STEP = 3u;
#endif
const uint END_OF_LIST = 0u;
