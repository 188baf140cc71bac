#include "kplus-dynamic/histogram.glsl"

// The largest k whose buffers fit as the article books them, whatever count_in is: 8 k N + 8 N (records; counters
// and locks), histogram and choice. In words of 4 bytes, and k N in 32 bits.
uint most_by_memory()
{
    const uint pixels = uint(FM_PIXELS), words = uint(MEMORY_MIB) << 18;
    const uint fixed_words = 2u * pixels + DEEPEST + 1u + 2u;
    return words > fixed_words ? (words - fixed_words) / 2u / pixels : 0u;
}

uint all_fragments()
{
    uint sum = histogram[0];
    FM_LOOP for (uint f = 1u; f <= DEEPEST; ++f)
        sum += f * histogram[f];
    return sum;
}

// K walks down from the last bin: as long as the axis or the memory forbids it, and then as long as one less
// discards no more than is allowed. `discarded` is what K would discard; one less discards a fragment
// more of each pixel that has K or more.
void choose(uint tile)
{
    if (tile != 0u) // one invocation
        return;
    uint all = all_fragments(), most = min(uint(K), most_by_memory());
    uint allowed = all / 100u * uint(DISCARD) + all % 100u * uint(DISCARD) / 100u;
    uint chosen = DEEPEST, discarded = histogram[0], deep_pixels = histogram[DEEPEST];
    FM_LOOP while (chosen > 1u && (chosen > most || discarded + deep_pixels <= allowed)) {
        discarded += deep_pixels;
        --chosen;
        deep_pixels += histogram[chosen];
    }
    choice[0] = chosen;
    choice[1] = chosen * uint(FM_PIXELS);
}
