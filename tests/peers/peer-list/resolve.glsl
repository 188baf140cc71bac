uvec2 nearest[K]; // depth bits, colour: rising

// Behind those that are not farther; the last falls out of a full array.
void insert(uint count, uvec2 fragment)
{
    uint at = min(count, K - 1u);
    FM_LOOP while (at > 0u && nearest[at - 1u].x > fragment.x) {
        nearest[at] = nearest[at - 1u];
        --at;
    }
    nearest[at] = fragment;
}

void resolve(uvec2 pixel)
{
    uint link = heads[fm_pixel_index(pixel)], count = 0u;
    FM_LOOP while (link != 0u) {
        uvec4 node = nodes[link - 1u];
        if (count < K || node.y < nearest[K - 1u].x) {
            insert(count, node.yx);
            count = min(count + 1u, uint(K));
        }
        link = node.z;
    }
    FM_LOOP for (uint i = 0u; i < count; ++i) {
        uint rank = FM_RANK(i, count);
        fm_emit(pixel, int(rank), uintBitsToFloat(nearest[rank].x), nearest[rank].y);
    }
}
