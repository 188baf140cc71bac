#include "verdict.h"

const char *verdict_name(fm_verdict_kind kind)
{
    static const char *const names[FM_VERDICT_COUNT] = {
        [FM_VERDICT_HOLDS] = "holds",
        [FM_VERDICT_UNCLEAR] = "unclear",
        [FM_VERDICT_FAILS] = "fails",
        [FM_VERDICT_NOT_TESTABLE] = "not testable here",
    };
    return names[kind];
}
