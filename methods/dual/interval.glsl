// An interval of depths as MAX blending finds it: (-nearest, farthest) of all that was written. (-1, -1),
// the clear value, is neutral: no depth is below 0 or above 1. Its farthest of -1 says that it is empty.
const vec2 EMPTY_INTERVAL = vec2(-1.0);
