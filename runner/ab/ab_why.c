/* What is told beside a verdict. */
#include "ab.h"

size_t ab_count(const ab_result *result, ab_verdict verdict)
{
    size_t count = 0;
    for (size_t i = 0; i < result->count; i++)
        count += result->cases[i].verdict == verdict;
    return count;
}

static void add_reason(fm_text *why, const char *reason)
{
    text_add(why, "%s%s", why->length > 0 ? "; " : "", reason);
}

static void add_unclear(fm_text *why, const ab_case *of, const ab_policy *policy)
{
    const ab_judged *judged = &of->tested.judged[looks_decisive(&of->tested)];
    char text[96];
    if (of->tested.is_not_confirmed)
        snprintf(text, sizeof text, "looked worse; %u fresh pairs did not confirm it",
                 policy->looks[0]);
    else if (judged->pairs_wanted > 0)
        snprintf(text, sizeof text, "%u pairs might decide", judged->pairs_wanted);
    else
        snprintf(text, sizeof text, "too noisy for %d pairs", DECIDE_VALUES);
    add_reason(why, text);
}

void ab_why(fm_text *why, const ab_case *of, const ab_policy *policy)
{
    char text[96];
    if (of->tested.is_confirmed) {
        snprintf(text, sizeof text, "confirmed on %u fresh pairs", policy->looks[0]);
        add_reason(why, text);
    }
    if (of->changes.length > 0)
        add_reason(why, of->changes.bytes);
    if (of->verdict == AB_UNCLEAR)
        add_unclear(why, of, policy);
    for (int side = 0; side < AB_SIDE_COUNT; side++)
        if (of->status[side] != FM_CASE_OK && of->message[side][0] != '\0')
            text_add(why, "%s%s: %s", why->length > 0 ? "; " : "", ab_side_names[side],
                     of->message[side]);
}
