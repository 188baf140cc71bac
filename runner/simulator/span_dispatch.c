#include "span.h"

tbr_span_function *span_function(bool no_vectors)
{
#if defined(__x86_64__)
    if (!no_vectors && __builtin_cpu_supports("avx2"))
        return span_draw_avx2;
#endif
    (void)no_vectors;
    return span_draw_portable;
}
