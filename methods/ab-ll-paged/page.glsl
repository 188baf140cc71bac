// A page is nine words: a link to the page filled before, then four fragments (depth bits, colour).
// A link holds the page's first word plus one, so that it is the first fragment's place; 0 ends.
const uint PAGE = 4u, PAGE_WORDS = 9u;
const uint END_OF_LIST = 0u;
const uint NO_ROOM = 0xFFFFFFFFu; // instead of a page, until the pool has grown
