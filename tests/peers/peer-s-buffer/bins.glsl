// bins[0..S-1]: how many fragments the pixels of each shared counter have; bins[S..2S-1]: where its stretch of
// the pool begins.
const uint S = 32u;

// The authors' tiles. Their numbers leave some counters unused, and let tiles share others.
uint bin_of(uvec2 pixel)
{
    uvec2 tile = pixel / uvec2(256u, 192u);
    return (tile.x * 4u + tile.y) % S;
}
