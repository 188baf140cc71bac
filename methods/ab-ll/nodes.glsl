// Nodes by their links, for passes that have the pool.
#include "ab-ll/node.glsl"

#if NODES_WHOLE
#define next_word(link) nodes[(link) - 1u].z
#else
#define next_word(link) nodes[(link) + 1u]
#endif

// A fragment, and the link to the next: what reads both reads them by this, so that a whole node is read once.
uvec3 node_at(uint link)
{
#if NODES_WHOLE
    return nodes[link - 1u].xyz;
#else
    return uvec3(nodes[link - 1u], nodes[link], nodes[link + 1u]);
#endif
}
uint depth_bits_of(uint link)
{
#if NODES_WHOLE
    return nodes[link - 1u].x;
#else
    return nodes[link - 1u];
#endif
}
uvec2 fragment_of(uint link)
{
    return node_at(link).xy;
}
uint next_of(uint link)
{
    return next_word(link);
}

// No functions: passes that only read, or do not emit, could not have them.
#define emit_node(pixel, node, rank) fm_emit(pixel, int(rank), uintBitsToFloat((node).x), (node).y)
#if NODES_WHOLE
#define set_fragment(link, fragment)   nodes[(link) - 1u].xy = fragment
#define set_node(link, fragment, next) nodes[(link) - 1u] = uvec4(fragment, next, 0u)
#else
#define set_fragment(link, fragment)     \
    {                                    \
        nodes[(link) - 1u] = fragment.x; \
        nodes[link] = fragment.y;        \
    }
#define set_node(link, fragment, next) \
    {                                  \
        set_fragment(link, fragment);  \
        next_word(link) = next;        \
    }
#endif
#define set_next(link, next) next_word(link) = next
