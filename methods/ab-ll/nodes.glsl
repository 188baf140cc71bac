// Nodes by their links, for passes that have the pool.
#include "ab-ll/node.glsl"

uint depth_bits_of(uint link)
{
    return nodes[link - 1u];
}
uvec2 fragment_of(uint link)
{
    return uvec2(nodes[link - 1u], nodes[link]);
}
uint next_of(uint link)
{
    return nodes[link + 1u];
}

// No functions: passes that only read, or do not emit, could not have them.
#define emit_node(pixel, link, rank) \
    fm_emit(pixel, int(rank), uintBitsToFloat(depth_bits_of(link)), fragment_of(link).y)
#define set_next(link, next) nodes[(link) + 1u] = next
#define set_fragment(link, fragment)    \
    {                                   \
        nodes[(link) - 1u] = fragment.x; \
        nodes[link] = fragment.y;       \
    }
#define set_node(link, fragment, next)  \
    {                                   \
        set_fragment(link, fragment)    \
        set_next(link, next);           \
    }
