// The k nearest of a pixel's fragments, in one pass over them: select_none(), select_nearest() for each of them,
// emit_selected(). The method's option select says how the k nearest so far are kept:
//   registers  in order, in registers; where k is beyond what an invocation has of them, as heap
//   heap       as a max-heap, in a private array
//   farthest   as the k+-buffer paper has it
#define SELECT_REGISTERS_MAX 64
#if SELECT == SELECT_FARTHEST
#include "common/select_farthest.glsl"
#elif SELECT == SELECT_REGISTERS && K <= SELECT_REGISTERS_MAX
#include "common/select_in_registers.glsl"
#else
#include "common/select_by_heap.glsl"
#endif
