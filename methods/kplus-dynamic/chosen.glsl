// From here on K is what was chosen for this frame, at most the axis k, which sizes private arrays.
const uint K_MOST = uint(K);
#define SORT_CAPACITY K_MOST
#undef K
uint k_chosen = choice[0];
#define K k_chosen
