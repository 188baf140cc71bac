// A node is three words: depth bits, colour, next. A link holds the node's first word plus one; 0 ends.
const uint NODE_WORDS = 3u;
const uint END_OF_LIST = 0u;
