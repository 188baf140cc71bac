// A node is three words: depth bits, colour, next; a link is the node's first word. Each pixel has two
// sentinels: a head before all fragments and a tail behind them.
const uint NODE_WORDS = 3u;
const uint DEPTH = 0u, COLOUR = 1u, NEXT = 2u;

uint head_of(uvec2 pixel)
{
    return 2u * NODE_WORDS * fm_pixel_index(pixel);
}
