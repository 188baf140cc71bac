// Text that is repeated with the constants 0 to 7 behind i: an array whose indices are all constants lies in registers, and
// no compiler has to be trusted to unroll.
#define EIGHT(of, i)      of(i) of(i + 1u) of(i + 2u) of(i + 3u) of(i + 4u) of(i + 5u) of(i + 6u) of(i + 7u)
#define SIXTEEN(of, i)    EIGHT(of, i) EIGHT(of, i + 8u)
#define THIRTY_TWO(of, i) SIXTEEN(of, i) SIXTEEN(of, i + 16u)
#define SIXTY_FOUR(of, i) THIRTY_TWO(of, i) THIRTY_TWO(of, i + 32u)
