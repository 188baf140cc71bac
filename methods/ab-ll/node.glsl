// A node is three words: depth bits, colour, next. A link holds the node's first word plus one; 0 ends.
// nodes.glsl reads and writes them.
const uint NODE_STEP = 3u; // elements of the pool
const uint END_OF_LIST = 0u;
