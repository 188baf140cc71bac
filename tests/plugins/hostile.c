/* Plugins that do what no plugin should: each is built of this file, with DEED, one of the
 * functions of deeds.h, and PLACE, where it is done: in_constructor, or in_hook, where the method
 * is good until its hook is called; or with a field of the descriptor that is wrong. They lie in
 * folders of their own, so that only the tests of broken plugins meet them. */
#include "deeds.h"
#include "head.h"

#ifndef DEED
#define DEED nothing
#endif
#ifndef PLACE
#define PLACE in_constructor
#endif
#ifndef ANSWER
#define ANSWER FM_NEXT
#endif
#ifndef TITLE
#define TITLE "Hostile"
#endif
#ifndef SIZE
#define SIZE sizeof(fm_method_desc)
#endif
#ifndef ABI
#define ABI FM_ABI
#endif
#ifndef TRAITS
#define TRAITS FM_TRAIT_CONTROL
#endif
#ifndef RESOLVE_SHADER
#define RESOLVE_SHADER "resolve.glsl"
#endif

/* Which of the two functions below does it. */
enum { in_constructor, in_hook };

__attribute__((constructor)) static void act(void)
{
    if (PLACE == in_constructor)
        DEED();
}

/* Called in each frame, between two passes. */
__attribute__((unused)) static fm_next after(const fm_workload *workload, const char *pass)
{
    static const unsigned answer = (unsigned)ANSWER; /* C lets it be none of them */
    fm_next next;
    (void)workload;
    (void)pass;
    if (PLACE == in_hook)
        DEED();
    memcpy(&next, &answer, sizeof next);
    return next;
}

#ifdef ZEROS
const fm_method_desc fm_method = { 0 };
#else
const fm_method_desc fm_method = {
    HEAD(ID),
    .abi = ABI,
    .size_bytes = SIZE,
    .title = TITLE,
    .traits = TRAITS,
    .resources = { NEAREST },
    .passes = { { .name = "clear",
                  .kind = FM_PASS_CLEAR,
                  .writes = { "nearest" },
                  .clear_word = 0x7F800000u },
                STORE,
                { .name = "ask", .kind = FM_PASS_HOST },
                { .name = "resolve",
                  .kind = FM_PASS_PIXELS,
                  .shader = RESOLVE_SHADER,
                  .reads = { "nearest" },
                  .emits = true } },
    .keeps = FM_KEEPS_NEAREST,
    .after = after,
};
#endif
