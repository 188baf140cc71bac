#include "verdict.h"

#include <stdio.h>

const char *verdict_name(fm_verdict_kind kind)
{
    static const char *const names[FM_VERDICT_COUNT] = {
        [FM_VERDICT_HOLDS] = "holds",
        [FM_VERDICT_IN_PART] = "holds in part",
        [FM_VERDICT_UNCLEAR] = "unclear",
        [FM_VERDICT_FAILS] = "fails",
        [FM_VERDICT_NOT_TESTABLE] = "not testable here",
    };
    return names[kind];
}

void verdict_words(char words[FM_VERDICT_WORDS_BYTES], const fm_verdict *verdict)
{
    const char *where = verdict->is_elsewhere ? " on another scene" : "";
    if (verdict->kind != FM_VERDICT_IN_PART)
        snprintf(words, FM_VERDICT_WORDS_BYTES, "%s", verdict_name(verdict->kind));
    else if (verdict->judged < verdict->total)
        snprintf(words, FM_VERDICT_WORDS_BYTES, "holds for %zu of %zu points%s", verdict->judged,
                 verdict->total, where);
    else
        snprintf(words, FM_VERDICT_WORDS_BYTES, "holds%s", where);
}
